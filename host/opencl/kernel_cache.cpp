#include "opencl/kernel_cache.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/error.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

/// What the kernels of one run take at most, with the compiler's temporary files.
constexpr std::uintmax_t room_for_kernels = 64u << 20;

/// Raised when entries of another make would be misread.
constexpr const char* format = "causticl kernels 2";

fs::path cache_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value ? value : "");
  };
  if (fs::path own = variable("CAUSTICL_CACHE_DIR"); !own.empty()) return own;
  // The XDG specification has relative paths ignored.
  if (const fs::path shared = variable("XDG_CACHE_HOME"); shared.is_absolute()) return shared / "causticl";
  if (const fs::path home = variable("HOME"); home.is_absolute()) return home / ".cache" / "causticl";
  return {};
}

/// A folder of this run in the first place that has room and that no other user can change. Throws UserError
/// with what is wrong with the first.
void make_temporary_folder(std::optional<RunFolder>& run) {
  std::string first_fault;
  const char* wanted = std::getenv("TMPDIR");
  for (const fs::path& parent :
       {fs::path(wanted ? wanted : ""), fs::path("/tmp"), fs::path("/var/tmp"), fs::path("/dev/shm")}) {
    std::error_code error;
    if (!parent.is_absolute() || !fs::is_directory(parent, error)) continue;
    try {
      run.emplace(parent, room_for_kernels);
      return;
    } catch (const UserError& fault) {
      if (first_fault.empty()) first_fault = fault.what();
    }
  }
  throw UserError(first_fault.empty() ? "there is no temporary folder" : first_fault);
}

/// Whether the environment sets the variable, and to something.
bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

std::string key_of(const ProgramText& text) {
  return std::string(format) + "\n" + text.driver + "\n" + text.options + "\n" + text.source;
}

/// PoCL's folders of programs: two levels below its own.
std::set<std::string> program_folders(const fs::path& top) {
  std::set<std::string> result;
  std::error_code error;
  for (const auto& first : fs::directory_iterator(top, error)) {
    if (!first.is_directory()) continue;
    for (const auto& second : fs::directory_iterator(first.path(), error))
      if (second.is_directory()) result.insert(second.path().lexically_relative(top).generic_string());
  }
  return result;
}

/// The names of all files below `top` / `folder`, from `top` on; not of PoCL's time stamps.
std::set<std::string> files_below(const fs::path& top, const std::string& folder) {
  std::set<std::string> result;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(top / folder, error))
    if (entry.is_regular_file() && entry.path().filename() != "last_accessed")
      result.insert(entry.path().lexically_relative(top).generic_string());
  return result;
}

/// Throws std::runtime_error where one cannot be read.
KernelFiles read_files(const fs::path& top, const std::set<std::string>& names) {
  KernelFiles files;
  for (const auto& name : names) {
    std::ifstream in(top / name, std::ios::binary);
    if (!in) throw std::runtime_error((top / name).string() + " cannot be read");
    files.push_back({name, {std::istreambuf_iterator<char>(in), {}}});
  }
  return files;
}

/// The first two levels of a file's name: the folder of its program.
std::string program_folder_of(const std::string& name) {
  return name.substr(0, name.find('/', name.find('/') + 1));
}

}  // namespace

cl::Program build_from_source(const cl::Context& context, const cl::Device& device, const ProgramText& text) {
  cl::Program program(context, text.source);
  program.build(device, text.options.c_str());
  return program;
}

KernelCache::KernelCache(bool keep, std::uint64_t limit) {
  const bool has_folder = is_set("POCL_CACHE_DIR") && is_users_folder_trusted();
  pocl_is_the_users_ = has_folder || is_set("POCL_KERNEL_CACHE");
  open(keep, limit);
  // PoCL's own default is a folder that others may have made, where there is no home.
  sets_pocl_folder_ = run_ && !has_folder;
  if (sets_pocl_folder_) setenv("POCL_CACHE_DIR", run_->path().c_str(), 1);
}

KernelCache::~KernelCache() {
  store_compiled();
  if (sets_pocl_folder_) unsetenv("POCL_CACHE_DIR");
}

bool KernelCache::is_users_folder_trusted() {
  try {
    open_trusted_folder(std::getenv("POCL_CACHE_DIR"), FolderUse::own);
    return true;
  } catch (const UserError& error) {
    notices_.push_back("POCL_CACHE_DIR is not used: " + std::string(error.what()));
    return false;
  }
}

void KernelCache::open(bool keep, std::uint64_t limit) {
  const fs::path folder = cache_folder();
  std::string fault = "neither CAUSTICL_CACHE_DIR nor HOME is set";
  if (keep && !folder.empty()) try {
      store_.emplace(folder, limit);
      run_.emplace(store_->path(), room_for_kernels);
      return;
    } catch (const UserError& error) {
      fault = error.what();
      store_.reset();
    }
  if (keep)
    notices_.push_back("kernels are not kept for the next run: " + fault +
                       "; set CAUSTICL_CACHE_DIR to a folder of your own with room, or say --no-cache");
  try {
    make_temporary_folder(run_);
  } catch (const UserError& error) {
    no_run_folder_ = error.what();  // of which PoCL alone has need
  }
}

std::optional<KernelFiles> KernelCache::load(const std::string& key) {
  if (!store_) return {};
  std::string damage;
  auto files = store_->load(key, damage);
  if (!damage.empty()) notices_.push_back(damage);
  return files;
}

void KernelCache::save(const std::string& key, const KernelFiles& files) {
  if (!store_) return;
  try {
    store_->save(key, files);
  } catch (const std::exception& error) {
    stop_storing(error);
  }
}

void KernelCache::stop_storing(const std::exception& why) {
  notices_.push_back("kernels are not kept for the next run: " + std::string(why.what()));
  store_.reset();
}

cl::Program KernelCache::build(const cl::Context& context, const cl::Device& device, const ProgramText& text,
                               KernelForm form) {
  if (form == KernelForm::binary) return build_binary(context, device, text);
  return pocl_is_the_users_ ? build_from_source(context, device, text) : build_pocl(context, device, text);
}

cl::Program KernelCache::build_pocl(const cl::Context& context, const cl::Device& device,
                                    const ProgramText& text) {
  if (!run_)
    throw DeviceError("kernels cannot be built: " + no_run_folder_ +
                      "; set CAUSTICL_CACHE_DIR or TMPDIR to a folder with room");
  // PoCL builds one program at a time whatever it is asked for, and a folder that is new is this program's.
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string key = key_of(text);
  // Its files may be in use: they must not be written again.
  if (pocl_programs_.contains(key)) return build_from_source(context, device, text);
  PoclProgram known;
  if (const auto kept = load(key)) known = fill_run_folder(*kept);
  const auto before = program_folders(run_->path());
  cl::Program program = build_from_source(context, device, text);
  for (const auto& folder : program_folders(run_->path()))
    if (!before.contains(folder)) known = {folder, {}};  // also where the store's was of no use to this PoCL
  if (!known.stored.empty()) ++reused_;
  if (!known.folder.empty()) pocl_programs_[key] = std::move(known);
  return program;
}

KernelCache::PoclProgram KernelCache::fill_run_folder(const KernelFiles& files) {
  const fs::path& top = run_->path();
  std::error_code error;
  PoclProgram program;
  if (files.empty()) return program;
  program.folder = program_folder_of(files.front().name);
  // Texts that the preprocessor makes one share a folder, and its files may be in use.
  if (program.stored = files_below(top, program.folder); !program.stored.empty()) return program;
  for (const auto& file : files) {
    fs::create_directories((top / file.name).parent_path(), error);
    std::ofstream out(top / file.name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(file.bytes.data()),
              static_cast<std::streamsize>(file.bytes.size()));
    program.stored.insert(file.name);
    if (out.flush()) continue;
    notices_.push_back("no room in " + top.parent_path().string() + "; kernels are built anew");
    for (const auto& name : program.stored) fs::remove(top / name, error);
    return {};
  }
  return program;
}

cl::Program KernelCache::build_binary(const cl::Context& context, const cl::Device& device,
                                      const ProgramText& text) {
  const std::string key = key_of(text);
  std::optional<KernelFiles> kept;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    kept = load(key);
  }
  if (kept && !kept->empty()) try {
      cl::Program program(context, {device}, cl::Program::Binaries{kept->front().bytes});
      program.build(device, text.options.c_str());
      const std::lock_guard<std::mutex> lock(mutex_);
      ++reused_;
      return program;
    } catch (const cl::Error&) {
      // The driver knows better what it can load than its version told: from the source, then.
    }
  cl::Program program = build_from_source(context, device, text);
  const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!binaries.empty() && !binaries.front().empty()) save(key, {{"binary", binaries.front()}});
  return program;
}

void KernelCache::store_compiled() {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    for (auto& [key, program] : pocl_programs_) {
      if (!store_) return;
      auto files = files_below(run_->path(), program.folder);
      if (files.empty() || files == program.stored) continue;
      save(key, read_files(run_->path(), files));
      program.stored = std::move(files);
    }
  } catch (const std::exception& error) {
    stop_storing(error);
  }
}

std::size_t KernelCache::reused() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return reused_;
}

std::vector<std::string> KernelCache::take_notices() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(notices_, {});
}

}  // namespace causticl
