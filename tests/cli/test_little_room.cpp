// Where something is missing that a run takes for granted: a clear line and exit code 3, or the work is done
// without it; and nothing is left over by runs that a signal ends.
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <thread>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "measured.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

const Words a_render = small_render({"--passes", "1", "--quiet", "-o", "a.pfm"});

/// One kernel, which takes a second to compile.
const Words one_kernel{"selftest", "--case", "square root", "--inputs", "100", "--threads", "1"};

bool tests_run_on_pocl() { return test_device().info().platform_name == "Portable Computing Language"; }

void check_done(const MeasuredRun& run) {
  CAPTURE(run.errors);
  CHECK(run.exit_code == 0);
}

/// A clear line, and the exit code that says that the device or what is around it is at fault.
void check_device_error(const MeasuredRun& run, const std::string& part) {
  CAPTURE(run.errors);
  CHECK(run.exit_code == 3);
  CHECK_THAT(run.errors, Contains("causticl: error: ") && Contains(part));
}

/// In the new process: kernels are kept in `cache`, and PoCL has no folder of the tests.
void keep_in(const std::string& cache) {
  setenv("CAUSTICL_CACHE_DIR", cache.c_str(), 1);
  unsetenv("POCL_CACHE_DIR");
}

/// In the new process: mounts that others do not see. False where this user may not.
bool own_mounts() {
  return unshare(CLONE_NEWNS) == 0 && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

bool may_mount() {
  const pid_t child = fork();
  if (child == 0) _exit(own_mounts() ? 0 : 1);
  int status = 1;
  waitpid(child, &status, 0);
  if (status != 0) WARN("skipped: this user may not mount file systems");
  return status == 0;
}

std::vector<std::string> run_folders(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& name : names_in(folder))
    if (name.starts_with("causticl-run-")) found.push_back(name);
  return found;
}

}  // namespace

TEST_CASE("without a home, or a temporary folder, kernels are compiled and run") {
  const TemporaryFolder folder;
  const std::string path = folder.path("");
  check_done(run_measured(one_kernel, path, [] {
    for (const char* name : {"HOME", "XDG_CACHE_HOME", "CAUSTICL_CACHE_DIR", "TMPDIR", "POCL_CACHE_DIR"})
      unsetenv(name);
  }));
  check_done(run_measured(one_kernel, path, [&] {
    keep_in(folder.path("cache"));
    setenv("TMPDIR", "/nonexistent", 1);
    setenv("HOME", "relative", 1);
  }));
  CHECK(!names_in(folder.path("cache")).empty());
}

TEST_CASE("folders of kernels that others can change are not used, a line says why, a private one serves") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path("open"));
  chmod(folder.path("open").c_str(), 01777);
  const auto render = [&](const std::vector<std::pair<std::string, std::string>>& environment) {
    const Finished run = run_causticl(one_kernel, folder.path(""), environment);
    check_success(run);
    CHECK(names_in(folder.path("open")).empty());
    CHECK_THAT(run.errors, Contains("open: other users may write to it (mode 1777)"));
    return run.errors;
  };
  CHECK_THAT(render({{"CAUSTICL_CACHE_DIR", folder.path("open")}, {"POCL_CACHE_DIR", ""}}),
             Contains("kernels are not kept for the next run: "));
  if (!tests_run_on_pocl()) return;
  CHECK_THAT(render({{"CAUSTICL_CACHE_DIR", folder.path("cache")}, {"POCL_CACHE_DIR", folder.path("open")}}),
             Contains("POCL_CACHE_DIR is not used: "));
  CHECK(!names_in(folder.path("cache")).empty());
}

TEST_CASE("kernels that all users may write to are not built") {
  const TemporaryFolder folder;
  fs::copy(CAUSTICL_SOURCE_DIR "/cl", folder.path("cl"), fs::copy_options::recursive);
  const Words words = a_render + Words{"--kernel-dir", "cl"};
  for (const char* open : {"cl", "cl/passes", "cl/passes/pass_film.cl", "cl/shapes"}) {
    const auto before = fs::status(folder.path(open)).permissions();
    fs::permissions(folder.path(open), fs::perms::others_write, fs::perm_options::add);
    check_one_error(run_causticl(words, folder.path("")), 2,
                    "--kernel-dir: all users may write to " + std::string(open));
    fs::permissions(folder.path(open), before);
  }
}

TEST_CASE("a full disk of kernels, one without room for files, and no /sys") {
  if (!may_mount()) return;
  const TemporaryFolder folder;
  const std::string path = folder.path("");
  fs::create_directories(folder.path("disk"));
  for (const char* options : {"size=8m,mode=700", "size=200m,nr_inodes=40,mode=700"}) {
    CAPTURE(options);
    const MeasuredRun run = run_measured(one_kernel, path, [&] {
      if (!own_mounts() || mount("none", folder.path("disk").c_str(), "tmpfs", 0, options) != 0) _exit(99);
      keep_in(folder.path("disk"));
    });
    check_done(run);
    CHECK_THAT(run.errors, Contains("kernels are not kept for the next run: ") && Contains("disk: there "));
  }
  // Nowhere to write to at all.
  const auto no_room = [&] {
    if (!own_mounts()) _exit(99);
    for (const char* place : {"/tmp", "/var/tmp", "/dev/shm"})
      if (fs::exists(place) && mount("none", place, "tmpfs", 0, "size=1m,mode=1777") != 0) _exit(99);
    unsetenv("CAUSTICL_CACHE_DIR");
    unsetenv("XDG_CACHE_HOME");
    unsetenv("HOME");
    unsetenv("TMPDIR");
    unsetenv("POCL_CACHE_DIR");
  };
  if (!tests_run_on_pocl()) return;
  const std::string binary = CAUSTICL_BINARY;
  if (binary.starts_with("/tmp/") || binary.starts_with("/var/tmp/") || binary.starts_with("/dev/shm/"))
    WARN("skipped: causticl itself lies in a temporary folder");
  else
    check_device_error(run_measured(one_kernel, "/", no_room), "kernels cannot be built: /tmp: there are ");
  check_device_error(run_measured(a_render, path,
                                  [] {
                                    if (!own_mounts() || umount2("/sys", MNT_DETACH) != 0) _exit(99);
                                  }),
                     "/sys is missing");
}

// AddressSanitizer needs terabytes of it.
#if !defined(__SANITIZE_ADDRESS__)
TEST_CASE("little address space: what needs no device works, and a line says what PoCL needs") {
  const TemporaryFolder folder;
  const auto limited = [](rlim_t megabytes) {
    return [=] {
      const rlimit limit{megabytes << 20, megabytes << 20};
      setrlimit(RLIMIT_AS, &limit);
    };
  };
  const MeasuredRun info = run_measured({"info", cornell_box}, folder.path(""), limited(300));
  CAPTURE(info.errors);
  CHECK(info.exit_code == 0);
  if (!tests_run_on_pocl()) return;
  check_device_error(run_measured(a_render, folder.path(""), limited(300)),
                     "the address space is limited to 300 MiB");
}
#endif

TEST_CASE("a signal while kernels are compiled ends the run soon, and leaves nothing over") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path("cache"));
  const std::vector<std::pair<std::string, std::string>> environment{
      {"CAUSTICL_CACHE_DIR", folder.path("cache")}, {"POCL_CACHE_DIR", ""}};
  const auto wait_for_folder = [&] {
    for (int i = 0; i < 6000 && run_folders(folder.path("cache")).empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  };
  const Words kept = small_render({"--passes", "1", "-o", "a.pfm"});
  // Once: it ends by itself, at the next program. Twice: at once.
  for (const int times : {1, 2}) {
    CAPTURE(times);
    Process process(kept, folder.path(""), Process::Stream::pipe, environment);
    wait_for_folder();
    process.send(SIGTERM);
    if (times == 2) {
      process.wait_for("interrupted");
      process.send(SIGTERM);
    }
    const Finished run = process.wait();
    CAPTURE(run.errors, run.exit_code, run.signal);
    CHECK((run.exit_code == 130 || run.signal == SIGTERM));
    CHECK(run_folders(folder.path("cache")).empty());
    for (const auto& name : names_in(folder.path(""))) CHECK((name == "cache" || name == "a.pfm"));
  }
  // Where no picture is at stake, once is enough.
  for (const Words& other : {Words{"explain", cornell_box, "--measure"}, Words{"selftest", "--quick"}}) {
    Process process(other, folder.path(""), Process::Stream::pipe, environment);
    wait_for_folder();
    process.send(SIGTERM);
    const Finished run = process.wait();
    CHECK(run.signal == SIGTERM);
    for (int i = 0; i < 3000 && !run_folders(folder.path("cache")).empty(); ++i)  // its helpers end after it
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK(run_folders(folder.path("cache")).empty());
  }
}
