// Programs that were compiled before need not be compiled again.
#pragma once

#include <CL/opencl.hpp>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/run_folder.hpp"
#include "opencl/kernel_store.hpp"

namespace causticl {

/// How a driver's compiled kernels are come by. PoCL keeps them as files, and would load a damaged one
/// without a look; its folder is therefore one of this process, filled with what the store holds. Of all
/// other drivers it is the program's binary.
enum class KernelForm { pocl_files, binary };

/// All that the kernels of a program depend on.
struct ProgramText {
  std::string driver;  // the device's name, and the versions of its driver and platform
  std::string options, source;
};

/// Compiled kernels in `$CAUSTICL_CACHE_DIR`, else `$XDG_CACHE_HOME/causticl`, else `~/.cache/causticl`. Must
/// be made before the first call of OpenCL, since PoCL reads then where its files are, and must outlive every
/// program. Where the user has set `POCL_CACHE_DIR`, to a folder that no other user can change, or
/// `POCL_KERNEL_CACHE`, PoCL does as they say. Compiled kernels are run as they are, so that a folder that
/// others can change is not used. Safe to call from any thread.
class KernelCache {
 public:
  /// `keep` false: nothing is taken from the folder and nothing put there.
  explicit KernelCache(bool keep, std::uint64_t limit = KernelStore::default_limit);
  ~KernelCache();
  KernelCache(const KernelCache&) = delete;
  KernelCache& operator=(const KernelCache&) = delete;

  /// Builds `text`, from what is kept of it where that is possible. Throws cl::Error, and DeviceError where
  /// PoCL has no folder to write to.
  cl::Program build(const cl::Context& context, const cl::Device& device, const ProgramText& text,
                    KernelForm form);

  /// Stores what drivers have compiled since the last call: PoCL compiles a kernel at its first launch. Where
  /// that fails, a notice says so and nothing more is stored.
  void store_compiled();

  /// Programs that were built of what was kept.
  std::size_t reused() const;

  /// What the user should know (no folder, no room, a damaged entry), since the last call.
  std::vector<std::string> take_notices();

 private:
  struct PoclProgram {
    std::string folder;            // of PoCL's, within the run's
    std::set<std::string> stored;  // names of the files there that the store has
  };
  mutable std::mutex mutex_;
  std::optional<RunFolder> run_;
  std::optional<KernelStore> store_;
  std::string no_run_folder_;  // why, where there is none
  bool pocl_is_the_users_ = false, sets_pocl_folder_ = false;
  std::map<std::string, PoclProgram> pocl_programs_;  // by key
  std::size_t reused_ = 0;
  std::vector<std::string> notices_;

  bool is_users_folder_trusted();
  void open(bool keep, std::uint64_t limit);
  std::optional<KernelFiles> load(const std::string& key);
  void save(const std::string& key, const KernelFiles& files);
  void stop_storing(const std::exception& why);
  /// Puts what was kept of a program where PoCL finds it. Nothing where there is no room.
  PoclProgram fill_run_folder(const KernelFiles& files);
  cl::Program build_pocl(const cl::Context& context, const cl::Device& device, const ProgramText& text);
  cl::Program build_binary(const cl::Context& context, const cl::Device& device, const ProgramText& text);
};

/// Compiles without any cache of ours. Throws cl::BuildError with the compiler's log.
cl::Program build_from_source(const cl::Context& context, const cl::Device& device, const ProgramText& text);

}  // namespace causticl
