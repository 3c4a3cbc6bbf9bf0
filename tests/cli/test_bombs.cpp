// Whatever a scene names, `info` is done with it, or through with it, in little memory and time.
#include <sys/stat.h>

#include "catch2.hpp"

#include "measured.hpp"
#include "scene/hostile_images.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr long most_kilobytes = 2048l << 10;  // of which the sanitizer's own is the larger part
constexpr double most_seconds = 20;
#else
constexpr long most_kilobytes = 256l << 10;
constexpr double most_seconds = 2;
#endif

MeasuredRun info(const Words& words, const TemporaryFolder& folder) {
  const MeasuredRun run = run_measured(Words{"info"} + words, folder.path(""));
  CAPTURE(words, run.errors);
  CHECK(run.signal == 0);
  CHECK(run.peak_kilobytes < most_kilobytes);
  CHECK(run.cpu_seconds < most_seconds);
  CHECK(std::count(run.errors.begin(), run.errors.end(), '\n') <= 1);
  return run;
}

void check_refused(const TemporaryFolder& folder, const std::string& scene, const std::string& part) {
  const MeasuredRun run = info({folder.write("scene.json", scene)}, folder);
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.errors, Contains(part));
}

std::string scene_with(const std::string& object, const std::string& lights = "[]") {
  return R"({"width":8,"height":8,"camera":{"position":[0,0,5],"target":[0,0,0],"fov":40},)"
         R"("renderer":{"type":"pt","sample":1},"objects":[)" +
         object + R"(],"lights":)" + lights + "}";
}

std::string textured(const std::string& file) {
  return scene_with(
      R"({"type":"sphere","radius":1,"material":{"type":"diffuse","color":{"type":"image","path":")" + file +
      R"("}}})");
}

std::string mesh(const std::string& file) {
  return scene_with(R"({"type":"mesh","path":")" + file +
                    R"(","material":{"type":"diffuse","color":[1,1,1]}})");
}

/// A file of which `bytes` stand at its beginning and nothing behind them.
void write_sparse(const TemporaryFolder& folder, const std::string& name, const std::string& bytes,
                  std::uintmax_t size) {
  fs::resize_file(folder.write(name, bytes), size);
}

std::string ply_header(const std::string& format, const std::string& vertices, const std::string& faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

}  // namespace

TEST_CASE("images that cost more than they are worth: little memory, little time, one line") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& bytes) {
    CAPTURE(name, bytes.size());
    folder.write(name, bytes);
    check_refused(folder, textured(name), name + ": cannot be decoded: ");
    check_refused(folder,
                  scene_with(R"({"type":"sphere","radius":1,"material":{"type":"diffuse","color":[1,1,1]}})",
                             R"([{"type":"environment","path":")" + name + R"("}])"),
                  name + ": cannot be decoded: ");
    const MeasuredRun compared = run_measured({"compare", name, name}, folder.path(""));
    CHECK(compared.exit_code == 2);
    CHECK_THAT(compared.errors, Contains(name + ": cannot be decoded: "));
    CHECK(compared.peak_kilobytes < most_kilobytes);
  };
  refused("a.png", png_of_zeros(16384, 16384, 1, 0, 1u << 20));
  refused("b.png", png_of_zeros(16384, 16384, 16, 6, 100));
  refused("c.png", png_of_zeros(1, 1, 8, 0, 32u << 20));
  refused("d.exr", exr_header(exr_window((1u << 28) - 1, 0), exr_window((1u << 28) - 1, 0)));
  for (const auto& bytes :
       {jpeg_without_data(16384, 16384, 1, false), jpeg_without_data(16384, 16384, 4800, true),
        jpeg_without_data(2880, 2880, 4800, true)}) {
    folder.write("e.jpg", bytes);
    check_refused(folder, textured("e.jpg"), "e.jpg: cannot be decoded: ");
  }
  // The largest that a small file may hold, of the kind that takes longest.
  folder.write("f.jpg", jpeg_without_data(2896, 2896, 32, true));
  CHECK(info({folder.write("scene.json", textured("f.jpg"))}, folder).exit_code == 0);
}

TEST_CASE("--max-image-memory bounds all images together, and says so") {
  const TemporaryFolder folder;
  folder.write("a.png", png_of_zeros(512, 512, 8, 2, 512 * (512 * 3 + 1)));
  const std::string scene = folder.write("scene.json", textured("a.png"));
  CHECK(info({scene}, folder).exit_code == 0);
  CHECK(info({scene, "--max-image-memory", "8M"}, folder).exit_code == 0);
  const MeasuredRun refused = info({scene, "--max-image-memory", "1M"}, folder);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.errors, Contains("a.png: cannot be decoded: it takes ") && Contains("1 MiB are left") &&
                                 Contains("--max-image-memory"));
  for (const char* size : {"", "0", "-1", "1X", "4GB", "2000T", "99999999999999999999"}) {
    CAPTURE(size);
    const MeasuredRun run = info({scene, "--max-image-memory", size}, folder);
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.errors, Contains("--max-image-memory"));
  }
}

TEST_CASE("sparse and huge files: little memory, little time, one line") {
  const TemporaryFolder folder;
  constexpr std::uintmax_t terabyte = std::uintmax_t{1} << 40;
  write_sparse(folder, "a.png", png_of_zeros(4, 4, 8, 0, 20), terabyte);
  check_refused(folder, textured("a.png"), "a.png: is a sparse file");
  write_sparse(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", terabyte);
  check_refused(folder, mesh("a.obj"), "a.obj: is a sparse file");
  write_sparse(folder, "a.ply", ply_header("binary_little_endian", "4000000000", "4000000000"), terabyte);
  check_refused(folder, mesh("a.ply"), "a.ply: is a sparse file");
  folder.write("b.ply", ply_header("binary_little_endian", "4000000000", "4000000000"));
  check_refused(folder, mesh("b.ply"), "b.ply: the header declares 4000000000");
  folder.write("c.ply", ply_header("ascii", "9223372036854775807", "1") + "0 0 0\n");
  check_refused(folder, mesh("c.ply"), "c.ply: the header declares 9223372036854775807");

  write_sparse(folder, "sparse.json", scene_with(""), terabyte);
  const MeasuredRun sparse = info({"sparse.json"}, folder);
  CHECK(sparse.exit_code == 2);
  CHECK_THAT(sparse.errors, Contains("at most 32 MiB"));
  std::string values = "0";
  for (int i = 0; i < 1'000'100; ++i) values += ",0";
  check_refused(folder, "{\"objects\":[" + values + "]}", "at most 1000000 values");
  check_refused(folder, "{\"path\":\"" + std::string(31u << 20, 'x') + "\",\"unknown\":0}", "unknown");
  check_refused(folder, std::string(1u << 20, '['), "64 levels of nesting");
}

TEST_CASE("all files that were found hostile") {
  const fs::path hostile = CAUSTICL_SOURCE_DIR "/../shared/cases/hostile";
  if (!fs::is_directory(hostile)) {
    WARN("skipped: there is no " << hostile.lexically_normal().string());
    return;
  }
  const TemporaryFolder folder;
  for (const auto& entry : fs::directory_iterator(hostile)) {
    const std::string file = fs::canonical(entry.path()).string(),
                      extension = entry.path().extension().string();
    CAPTURE(file);
    if (extension == ".json")
      info({file}, folder);
    else
      info({folder.write("scene.json", extension == ".ply" ? mesh(file) : textured(file))}, folder);
  }
}
