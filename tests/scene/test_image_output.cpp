// Pictures as they are written: the curve of PNG, and outputs that cannot be written.
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "catch2.hpp"
#include "image/image.hpp"
#include "temporary_folder.hpp"

namespace causticl {
namespace {}  // namespace

TEST_CASE("PNG clamps, takes the power 1/2.2 and rounds; NaN is black") {
  const TemporaryFolder folder;
  const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  const Picture picture{4, 1, {0, 1, 0.5f, -3, 7, inf, -inf, nan, 1e-30f, 0.18f, 0.002f, 0.9f}};
  write_picture(folder.path("a.png"), picture, {{"ignored", "x"}});
  const Image image = read_image(folder.path("a.png"), false);
  const std::vector<int> expected{0, 255, 186, 0, 255, 255, 0, 0, 0, 117, 15, 243};
  for (int i = 0; i < 12; ++i) {
    CAPTURE(i);
    CHECK(std::lround(image.rgba[std::size_t(i / 3 * 4 + i % 3)] * 255) == expected[std::size_t(i)]);
  }
}

TEST_CASE("Outputs are checked before the rendering, and a failed one leaves nothing behind") {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& name) {
    return user_error_of([&] { check_output(folder.path(name)); }, folder.path(name));
  };
  CHECK(fault("a.png") == "");
  CHECK(fault("a.EXR") == "");
  CHECK(std::filesystem::is_empty(folder.path("")));
  CHECK(fault("a.jpg") == "a.jpg: unknown output format; expected a name that ends in .png, .exr or .pfm");
  CHECK(fault("png") == "png: unknown output format; expected a name that ends in .png, .exr or .pfm");
  CHECK(user_error_of([] { check_output(""); }) ==
        ": unknown output format; expected a name that ends in .png, .exr or .pfm");
  CHECK(fault("none/a.png") ==
        "a.png: cannot be written: there is no folder " + folder.path("none") + "; create it first");
  folder.write("file", "x");
  CHECK(fault("file/a.png").find("a.png: cannot be written: ") == 0);
  std::filesystem::create_directory(folder.path("folder.png"));
  CHECK(fault("folder.png") == "folder.png: cannot be written: a folder has this name");
  CHECK(fault(std::string(300, 'a') + ".png").find("cannot be written: File name too long") !=
        std::string::npos);
  CHECK(user_error_of([] { check_output("/proc/a.png"); }).find("/proc/a.png: cannot be written: ") == 0);

  // Writing fails half-way: the old file stays whole, and no temporary stays.
  const std::string file = folder.write("a.pfm", "the old file");
  const Picture picture{200, 200, std::vector<float>(120000, 1)};
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const rlimit small_limit{10000, old_limit.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small_limit);
  const std::string message = user_error_of([&] { write_picture(file, picture, {}); }, file);
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  CHECK(message == "a.pfm: cannot be written: File too large");
  CHECK(bytes_of(file) == "the old file");
  CHECK(has_no_temporary(folder));
}

}  // namespace causticl
