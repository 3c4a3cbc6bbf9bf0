// Compiled kernels that are kept: never a wrong one, whatever happens to the files. What PoCL keeps is for
// tests/cli/test_cache_folder.cpp, since PoCL asks where its folder is once in the life of a process.
#include <cstdlib>
#include <fstream>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "opencl/kernel_cache.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
namespace fs = std::filesystem;

namespace {

const KernelFiles some_files{{"a/b/one.so", {1, 2, 3}}, {"a/b/none.bc", {}}};

bool same(const std::optional<KernelFiles>& found, const KernelFiles& expected) {
  if (!found || found->size() != expected.size()) return false;
  for (std::size_t i = 0; i < expected.size(); ++i)
    if ((*found)[i].name != expected[i].name || (*found)[i].bytes != expected[i].bytes) return false;
  return true;
}

/// CAUSTICL_CACHE_DIR for the time of a test.
struct CacheFolder {
  explicit CacheFolder(const std::string& folder) {
    test_device();  // so that PoCL's folder is its own, and not that of a run which ends with the test
    setenv("CAUSTICL_CACHE_DIR", folder.c_str(), 1);
  }
  ~CacheFolder() { unsetenv("CAUSTICL_CACHE_DIR"); }
  CacheFolder(const CacheFolder&) = delete;
  CacheFolder& operator=(const CacheFolder&) = delete;
};

/// What a kernel that writes `number` writes, built through `cache` for a driver of this version.
int built_number(KernelCache& cache, int number, const std::string& version) {
  Device& device = test_device();
  const ProgramText text{"driver " + version, "-cl-std=CL1.2",
                         "kernel void write(global int* out) { *out = " + std::to_string(number) + "; }"};
  const cl::Program program = cache.build(device.context(), device.cl_device(), text, KernelForm::binary);
  cl::Kernel kernel(program, "write");
  const cl::Buffer out = device.buffer(sizeof(int), "a number");
  kernel.setArg(0, out);
  device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
  return device.download<int>(out, 1)[0];
}

}  // namespace

TEST_CASE("an entry of kernels comes back as it was stored, under its key alone") {
  const TemporaryFolder folder;
  const KernelStore store(folder.path(""));
  std::string damage;
  CHECK(!store.load("key", damage));
  store.save("key", some_files);
  CHECK(same(store.load("key", damage), some_files));
  CHECK(!store.load("another key", damage));
  CHECK(damage.empty());
  store.save("key", {});
  CHECK(same(store.load("key", damage), {}));
}

TEST_CASE("a damaged entry is removed and reported, whichever byte it is") {
  const TemporaryFolder folder;
  const KernelStore store(folder.path(""));
  store.save("key", some_files);
  const fs::path file = store.file_of("key");
  const std::string whole = bytes_of(file);
  const auto refused = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    std::string damage;
    return !store.load("key", damage) && damage.find(file.string() + " is damaged") != damage.npos &&
           !fs::exists(file);
  };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    CAPTURE(i);
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 4);
    CHECK(refused(bytes));
    CHECK(refused(whole.substr(0, i)));
  }
  CHECK(refused(whole + "x"));
}

TEST_CASE("above its limit a store forgets what was not used for longest, and what killed processes left") {
  const TemporaryFolder folder;
  const KernelFiles kilobyte{{"file", std::vector<std::uint8_t>(1000, 7)}};
  const KernelStore store(folder.path(""), 3500);
  std::string damage;
  const auto age = [](const fs::path& file, int hours) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  for (int i = 0; i < 3; ++i) {
    store.save(std::to_string(i), kilobyte);
    age(store.file_of(std::to_string(i)), 9 - i);
  }
  CHECK(store.load("0", damage));  // the oldest is now the one used last
  const std::string old_half = folder.write(".entry-1", "half"), new_half = folder.write(".entry-2", "half"),
                    another = folder.write("b.tmp", "of another program");
  age(old_half, 2);
  age(another, 2);
  store.save("3", kilobyte);
  CHECK(fs::exists(store.file_of("0")));
  CHECK(!fs::exists(store.file_of("1")));
  CHECK(fs::exists(store.file_of("2")));
  CHECK(fs::exists(store.file_of("3")));
  CHECK(!fs::exists(old_half));
  CHECK(fs::exists(new_half));
  CHECK(fs::exists(another));
}

TEST_CASE("the folder of a run is its own and goes with it; those left behind go with the next") {
  const TemporaryFolder folder;
  const fs::path parent = folder.path("cache");
  fs::path path;
  {
    const RunFolder one(parent, 1), two(parent, 1);
    path = one.path();
    CHECK(one.path() != two.path());
    std::ofstream(path / "file") << "kernel";
    // Old and locked: in use.
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(1));
    const RunFolder three(parent, 1);
    CHECK(fs::exists(path / "file"));
  }
  CHECK(fs::is_empty(parent));
  for (const char* name : {"causticl-run-old", "causticl-run-new", "other"}) {
    fs::create_directories(parent / name);
    std::ofstream(parent / name / "in_use") << "";
  }
  for (const char* name : {"causticl-run-old", "other"})
    fs::last_write_time(parent / name, fs::file_time_type::clock::now() - std::chrono::hours(1));
  const RunFolder next(parent, 1);
  CHECK(!fs::exists(parent / "causticl-run-old"));
  CHECK(fs::exists(parent / "causticl-run-new"));  // its process may be about to lock it
  CHECK(fs::exists(parent / "other"));
  CHECK_THAT(user_error_of([&] { RunFolder(parent, UINTMAX_MAX); }), Catch::Contains(" MiB left"));
  CHECK_THAT(user_error_of([&] { RunFolder(folder.write("file", "") + "/cache", 1); }),
             Catch::Contains("cannot be made a folder"));
}

TEST_CASE("a program's binary is taken again for the same source and driver alone") {
  const TemporaryFolder folder;
  const CacheFolder place(folder.path("cache"));
  const auto build = [](int number, const std::string& version, std::size_t reused, bool keep = true) {
    KernelCache cache(keep);
    CHECK(built_number(cache, number, version) == number);
    CHECK(cache.reused() == reused);
    return cache.take_notices();
  };
  CHECK(build(1, "1.0", 0).empty());
  CHECK(build(1, "1.0", 1).empty());
  CHECK(build(2, "1.0", 0).empty());
  CHECK(build(1, "1.1", 0).empty());
  CHECK(build(1, "1.0", 0, false).empty());
  // A damaged entry is built anew and stored again.
  for (const auto& entry : fs::directory_iterator(folder.path("cache")))
    std::ofstream(entry.path(), std::ios::binary | std::ios::app) << "x";
  const auto notices = build(1, "1.0", 0);
  REQUIRE(notices.size() == 1);
  CHECK_THAT(notices[0], Catch::Contains("is damaged; its kernels are built anew"));
  CHECK(build(1, "1.0", 1).empty());
}

TEST_CASE("a driver that refuses a binary gets the source") {
  const TemporaryFolder folder;
  const CacheFolder place(folder.path("cache"));
  const ProgramText text{"driver", "-cl-std=CL1.2", "kernel void write(global int* out) { *out = 3; }"};
  Device& device = test_device();
  {
    KernelCache cache(true);
    cache.build(device.context(), device.cl_device(), text, KernelForm::binary);
  }
  const KernelStore store(folder.path("cache"));
  for (const auto& entry : fs::directory_iterator(folder.path("cache"))) {
    // The right name and a checksum that holds, of what is no binary.
    const TemporaryFolder other;
    const KernelStore forged(other.path(""));
    forged.save("any", {{"binary", {'n', 'o', 'n', 'e'}}});
    fs::copy_file(forged.file_of("any"), entry.path(), fs::copy_options::overwrite_existing);
  }
  KernelCache cache(true);
  const cl::Program program = cache.build(device.context(), device.cl_device(), text, KernelForm::binary);
  CHECK(cache.reused() == 0);
  CHECK_NOTHROW(cl::Kernel(program, "write"));
}

TEST_CASE("where kernels cannot be kept they are built all the same, and one line says so") {
  const TemporaryFolder folder;
  const CacheFolder place(folder.write("file", "") + "/cache");
  KernelCache cache(true);
  const auto notices = cache.take_notices();
  REQUIRE(notices.size() == 1);
  CHECK_THAT(notices[0], Catch::StartsWith("kernels are not kept for the next run: ") &&
                             Catch::Contains("set CAUSTICL_CACHE_DIR"));
  CHECK(built_number(cache, 5, "1") == 5);
}
