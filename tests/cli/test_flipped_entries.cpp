// Entries of kernels with a flipped bit, met by the program itself: none is used, each is built anew.
#include <random>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "small_render.hpp"

using namespace causticl;

namespace {

/// Runs one small check `count` times, each time with one bit of an entry flipped before.
void flip_entries(int count) {
  const TemporaryFolder folder;
  const std::string cache = folder.path("cache");
  const std::vector<std::pair<std::string, std::string>> environment{{"CAUSTICL_CACHE_DIR", cache},
                                                                     {"POCL_CACHE_DIR", ""}};
  Words words{"selftest", "--case", "square root", "--inputs", "100", "--threads", "1"};
  if (const char* device = std::getenv("CAUSTICL_DEVICE")) words = words + Words{"--device", device};
  const auto run = [&] {
    Finished finished = run_causticl(words, folder.path(""), environment);
    check_success(finished);
    return finished.errors;
  };
  CHECK(run().empty());
  CHECK(run().empty());
  constexpr unsigned seed = 20261129;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (int i = 0; i < count; ++i) {
    const auto names = names_in(cache);
    REQUIRE(!names.empty());
    const std::string file = cache + "/" + names[random() % names.size()];
    std::string bytes = bytes_of(file);
    const std::size_t at = random() % bytes.size();
    CAPTURE(i, file, at);
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    std::ofstream(file, std::ios::binary) << bytes;
    CHECK(run() == "causticl: note: the kernel cache's " + fs::canonical(cache).string() + "/" +
                       fs::path(file).filename().string() + " is damaged; its kernels are built anew\n");
    CHECK(bytes_of(file) != bytes);
  }
}

}  // namespace

TEST_CASE("flipped entries of kernels are never used") { flip_entries(8); }

TEST_CASE("a thousand flipped entries of kernels are never used", "[long]") { flip_entries(1000); }
