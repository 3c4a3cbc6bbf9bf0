// Folders and files that others can have written are not read, whoever they are and however they did it.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "catch2.hpp"

#include "base/private_folder.hpp"
#include "base/run_folder.hpp"
#include "opencl/kernel_store.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
namespace fs = std::filesystem;

namespace {

constexpr uid_t another_user = 65534;

/// The umask for the time of a test.
struct Umask {
  explicit Umask(mode_t mask) : before(umask(mask)) {}
  ~Umask() { umask(before); }
  mode_t before;
};

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  REQUIRE(lstat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

/// What opening it for this user alone complains of.
std::string fault_of(const fs::path& folder, FolderUse use = FolderUse::own) {
  return user_error_of([&] { open_trusted_folder(folder, use); });
}

const KernelFiles some_files{{"a/b/one.so", {1, 2, 3}}};

/// What a store says that holds one entry to which `change` was done; empty where it gave the entry out.
template <typename Change>
std::string fault_of_entry(Change change) {
  const TemporaryFolder folder;
  const KernelStore store(folder.path("cache"));
  store.save("key", some_files);
  change(store.file_of("key"));
  std::string damage;
  const bool used = store.load("key", damage).has_value();
  CHECK(used == damage.empty());
  struct stat status {};
  CHECK(used == (lstat(store.file_of("key").c_str(), &status) == 0));  // what was refused is gone
  return damage;
}

}  // namespace

TEST_CASE("folders and entries are made for this user alone, whatever the umask") {
  const TemporaryFolder folder;
  const Umask umask_of_the_test(0);
  const KernelStore store(folder.path("a/b"));
  store.save("key", some_files);
  const RunFolder run(folder.path("a/b"), 1);
  for (const fs::path& made : {fs::path(folder.path("a")), fs::path(folder.path("a/b")), run.path()})
    CHECK(mode_of(made) == 0700);
  CHECK(mode_of(store.file_of("key")) == 0600);
  CHECK(mode_of(run.path() / "in_use") == 0600);
}

TEST_CASE("a folder that others may write to is not used, nor one below it") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path("open/mine"));
  for (const mode_t mode : {0777u, 01777u, 0775u, 0707u}) {
    CAPTURE(mode);
    chmod(folder.path("open").c_str(), mode);
    CHECK_THAT(fault_of(folder.path("open")), Catch::Contains("open: other users may write to it (mode "));
    // With the sticky bit they cannot replace what is in it.
    CHECK(fault_of(folder.path("open/mine")).empty() == ((mode & S_ISVTX) != 0));
    CHECK(fault_of(folder.path("open"), FolderUse::parent).empty() == ((mode & S_ISVTX) != 0));
    CHECK(user_error_of([&] { RunFolder(folder.path("open"), 1); }).empty() == ((mode & S_ISVTX) != 0));
  }
  for (const mode_t mode : {0700u, 0755u}) {
    chmod(folder.path("open").c_str(), mode);
    CHECK(fault_of(folder.path("open/mine")).empty());
  }
  CHECK_THAT(user_error_of([&] { KernelStore("/tmp"); }), Catch::StartsWith("/tmp: "));
}

TEST_CASE("links are followed to where they lead, and what lies there is judged") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path("real/cache"));
  fs::create_directories(folder.path("open"));
  chmod(folder.path("open").c_str(), 0777);
  fs::create_symlink("real", folder.path("relative"));
  fs::create_symlink(folder.path("real"), folder.path("absolute"));
  fs::create_symlink("../open", folder.path("real/to_open"));
  fs::create_symlink("circle", folder.path("circle"));
  const fs::path real = fs::canonical(folder.path("real/cache"));
  for (const char* way :
       {"relative/cache", "absolute/cache", "relative/../real/./cache/", "absolute//cache"}) {
    CAPTURE(way);
    CHECK(open_trusted_folder(folder.path(way), FolderUse::own).path == real);
  }
  CHECK_THAT(fault_of(folder.path("relative/to_open")), Catch::Contains("open: other users may write to it"));
  CHECK_THAT(fault_of(folder.path("circle")), Catch::Contains("too many links"));
  CHECK_THAT(fault_of(folder.write("file", "")), Catch::Contains("there is a file of this name"));
  CHECK_THAT(fault_of(""), Catch::Contains("is no folder"));
}

TEST_CASE("what another user owns is not used") {
  if (geteuid() != 0) {
    WARN("skipped: only root can give files to another user");
    return;
  }
  const TemporaryFolder folder;
  fs::create_directories(folder.path("theirs/mine"));
  REQUIRE(chown(folder.path("theirs").c_str(), another_user, another_user) == 0);
  CHECK_THAT(fault_of(folder.path("theirs")), Catch::Contains("theirs: it belongs to user 65534"));
  CHECK_THAT(fault_of(folder.path("theirs/mine")), Catch::Contains("theirs: it belongs to user 65534"));
  CHECK_THAT(user_error_of([&] { RunFolder(folder.path("theirs"), 1); }),
             Catch::Contains("theirs: it belongs to user 65534"));
  // A link in a folder with the sticky bit, as /tmp, that another user made to a folder of ours.
  fs::create_directories(folder.path("shared"));
  fs::create_directories(folder.path("ours"));
  chmod(folder.path("shared").c_str(), 01777);
  fs::create_symlink(folder.path("ours"), folder.path("shared/link"));
  CHECK(fault_of(folder.path("shared/link")).empty());
  REQUIRE(lchown(folder.path("shared/link").c_str(), another_user, another_user) == 0);
  CHECK_THAT(fault_of(folder.path("shared/link")), Catch::Contains("shared/link: it belongs to user 65534"));

  CHECK_THAT(fault_of_entry([](const fs::path& entry) {
               REQUIRE(chown(entry.c_str(), another_user, another_user) == 0);
             }),
             Catch::Contains("belongs to user 65534; its kernels are built anew"));
  // Run folders that others left, or pretend to have left, are theirs.
  for (const char* name : {"causticl-run-mine", "causticl-run-theirs"}) {
    fs::create_directories(folder.path("shared") + "/" + name);
    fs::last_write_time(folder.path("shared") + "/" + name,
                        fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  const std::string theirs = folder.path("shared/causticl-run-theirs");
  REQUIRE(chown(theirs.c_str(), another_user, another_user) == 0);
  const RunFolder run(folder.path("shared"), 1);
  CHECK(fs::exists(theirs));
  CHECK(!fs::exists(folder.path("shared/causticl-run-mine")));
}

TEST_CASE("an entry that others can have written, or that is no file, is not used and goes") {
  CHECK(fault_of_entry([](const fs::path&) {}).empty());
  CHECK(fault_of_entry([](const fs::path& entry) { chmod(entry.c_str(), 0644); }).empty());
  for (const mode_t mode : {0666u, 0620u})
    CHECK_THAT(fault_of_entry([&](const fs::path& entry) { chmod(entry.c_str(), mode); }),
               Catch::Contains("may be written to by other users"));
  CHECK_THAT(fault_of_entry([](const fs::path& entry) {
               fs::rename(entry, entry.parent_path() / "moved");
               fs::create_symlink("moved", entry);
             }),
             Catch::Contains("is a link"));
  CHECK_THAT(fault_of_entry([](const fs::path& entry) {  // that nobody writes to
               fs::remove(entry);
               REQUIRE(mkfifo(entry.c_str(), 0600) == 0);
             }),
             Catch::Contains("is no regular file"));
  CHECK_THAT(fault_of_entry([](const fs::path& entry) { fs::resize_file(entry, std::uintmax_t{1} << 40); }),
             Catch::Contains("is larger than 256 MiB"));
}

TEST_CASE("names of an entry's files stay within their folder") {
  for (const char* name : {"binary", "ab/cdef/program.bc", "a/..b/c.", "a b/\xc3\xa9"})
    CHECK(is_name_within(name));
  for (const char* name : {"", "/", "/etc/x", "..", "../x", "a/../../x", "a/..", ".", "a/./b", "a//b", "a/",
                           "a\nb", "\x1b[31m", "a\x7f"}) {
    CAPTURE(name);
    CHECK(!is_name_within(name));
    // The checksum holds: it is made by the same function.
    const std::string packed = pack_kernels({{name, {1}}});
    CHECK(!unpack_kernels({packed.begin(), packed.end()}));
  }
  CHECK(!is_name_within(std::string("a\0b", 3)));
  CHECK(!is_name_within(std::string(256, 'a')));
}
