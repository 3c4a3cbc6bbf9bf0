// What is told to the user: numbers, progress, statistics, scene and devices.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include "catch2.hpp"

#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/render_setup.hpp"
#include "app/report.hpp"

using namespace causticl;
using Catch::Contains;
using Catch::StartsWith;

namespace {

/// All that `print` puts on a stream that is no terminal.
template <typename Print>
std::string printed(Print print) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::tmpfile(), std::fclose);
  REQUIRE(stream);
  print(stream.get());
  std::rewind(stream.get());
  std::string text;
  for (int c; (c = std::fgetc(stream.get())) != EOF;) text.push_back(static_cast<char>(c));
  return text;
}

Progress progress_at(std::uint64_t pass, double seconds) {
  return {pass, 100, seconds, 10, {}, {}, pass * 1000000, pass * 3000000};
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

Statistics example_statistics() {
  Statistics statistics;
  statistics.device = "Example device";
  statistics.passes = 7;
  statistics.photons = 700;
  statistics.seconds = 2.5;
  statistics.kernels["trace_photons"] = {30, 7};
  statistics.kernels["gather"] = {90, 14};
  return statistics;
}

Scene example_scene() {
  Scene scene;
  scene.file = "example.json";
  scene.width = 320;
  scene.height = 200;
  scene.camera.up = {0, 2, 0};
  scene.materials.resize(2);
  scene.materials[1].kind = MaterialSpec::Kind::glass;
  scene.materials[1].emission = {0, 3, 0};
  return scene;
}

Object object_at(Object::Shape shape, Vec3 position) {
  Object object;
  object.shape = shape;
  object.pointer = "/objects/0";
  object.transform = Transform::shift(position);
  return object;
}

}  // namespace

TEST_CASE("numbers are printed with three figures and a prefix") {
  CHECK(si_number(0) == "0");
  CHECK(si_number(999) == "999");
  CHECK(si_number(999.6) == "1.00 k");
  CHECK(si_number(12345) == "12.3 k");
  CHECK(si_number(999499) == "999 k");
  CHECK(si_number(999600) == "1.00 M");
  CHECK(si_number(4.56e6) == "4.56 M");
  CHECK(si_number(7.8e9) == "7.80 G");
}

TEST_CASE("times are printed as on a clock") {
  CHECK(clock_time(0) == "0:00");
  CHECK(clock_time(59.4) == "0:59");
  CHECK(clock_time(59.6) == "1:00");
  CHECK(clock_time(754) == "12:34");
  CHECK(clock_time(3723) == "1:02:03");
  CHECK(clock_time(-1) == "?");
  CHECK(clock_time(std::numeric_limits<double>::infinity()) == "?");
}

TEST_CASE("sizes are printed in binary units") {
  CHECK(byte_size(0) == "0 B");
  CHECK(byte_size(1023) == "1023 B");
  CHECK(byte_size(1536) == "1.50 KiB");
  CHECK(byte_size(3.0 * (1 << 30)) == "3.00 GiB");
}

TEST_CASE("the progress bar never exceeds its width") {
  for (int width = 0; width < 200; ++width)
    CHECK(progress_bar(progress_at(25, 7), 1e6, 3e6, width).size() <= static_cast<std::size_t>(width));
}

TEST_CASE("the progress bar shows the share done and, where there is room, every number") {
  const std::string bar = progress_bar(progress_at(25, 7), 1e6, 3e6, 150);
  CHECK(std::count(bar.begin(), bar.end(), '#') == 10);
  CHECK(std::count(bar.begin(), bar.end(), '.') >= 30);
  CHECK_THAT(bar, Contains("pass 25/100, 0:07 elapsed, 0:10 left, 1.00 M photons/s, 3.00 M rays/s"));
}

TEST_CASE("a narrow terminal keeps the pass and drops the rates") {
  CHECK(progress_text(progress_at(25, 7), 1e6, 3e6, 40) == "pass 25/100, 0:07 elapsed, 0:10 left");
}

TEST_CASE("the error and the time to half of it are shown once they are known") {
  Progress now = progress_at(25, 7);
  now.error = 0.0534;
  CHECK_THAT(progress_text(now, 1e6, 3e6, 150), Contains("0:10 left, error 5.3%, 1.00 M photons/s"));
  now.seconds_to_half = 754;
  CHECK_THAT(progress_text(now, 1e6, 3e6, 150),
             Contains("0:10 left, error 5.3%, half of it in 12:34, 1.00 M photons/s"));
  now.seconds_to_half = std::numeric_limits<double>::infinity();
  CHECK_THAT(progress_text(now, 1e6, 3e6, 150), Contains("half of it in ?, "));
  CHECK(percentage(0.00341) == "0.34%");
  CHECK(percentage(0.1234) == "12%");
}

TEST_CASE("where an error alone ends the render, what is known of it comes first") {
  Progress now = progress_at(12, 7);
  now.passes = 0;
  now.wanted_error = 0.02;
  now.remaining = std::numeric_limits<double>::infinity();
  CHECK(progress_text(now, 1e6, 3e6, 150) == "pass 12, 0:07 elapsed, 1.00 M photons/s, 3.00 M rays/s");
  now.error = 0.061;
  CHECK(progress_text(now, 1e6, 3e6, 40) == "pass 12, error 6.1% → 2%, 0:07 elapsed");
  now.remaining = 40;
  CHECK(progress_text(now, 1e6, 3e6, 60) == "pass 12, error 6.1% → 2%, about 0:40 left, 0:07 elapsed");
  // The arrow takes one column.
  CHECK(progress_text(now, 1e6, 3e6, 41) == "pass 12, error 6.1% → 2%, about 0:40 left");
  CHECK(progress_text(now, 1e6, 3e6, 40) == "pass 12, error 6.1% → 2%");
  const std::string bar = progress_bar(now, 1e6, 3e6, 150);
  CHECK(std::count(bar.begin(), bar.end(), '#') == 5);  // 7 of 47 seconds, of 40 columns
  now.passes = 100;
  CHECK_THAT(progress_text(now, 1e6, 3e6, 150), Contains("pass 12/100, ") && Contains("error 6.1% → 2%"));
}

TEST_CASE("path tracing shows no photons") {
  Progress now = progress_at(25, 7);
  now.photons = 0;
  CHECK_THAT(progress_text(now, 0, 3e6, 150), !Contains("photons") && Contains("3.00 M rays/s"));
}

TEST_CASE("lines of progress come at powers of two and at the end") {
  const std::string text = printed([](std::FILE* stream) {
    ProgressReport report(stream, false);
    for (std::uint64_t pass = 1; pass <= 100; ++pass)
      report.update(progress_at(pass, 0.01 * static_cast<double>(pass)));
  });
  CHECK(line_count(text) == 8);  // 1, 2, 4, 8, 16, 32, 64, 100
  CHECK_THAT(text, Contains("causticl: pass 64/100, ") && Contains("causticl: pass 100/100, "));
  CHECK_THAT(text, Contains("100 M photons/s, 300 M rays/s"));
}

TEST_CASE("lines of progress come at least every ten seconds") {
  const std::string text = printed([](std::FILE* stream) {
    ProgressReport report(stream, false);
    for (std::uint64_t pass = 65; pass < 100; ++pass)
      report.update(progress_at(pass, static_cast<double>(pass)));
  });
  CHECK(line_count(text) == 4);  // 65, 75, 85, 95
}

TEST_CASE("the start-up is left out of the rates") {
  const std::string text = printed([](std::FILE* stream) {
    ProgressReport report(stream, false);
    report.update(progress_at(1, 50));
    report.update(progress_at(2, 51));
  });
  CHECK_THAT(text, Contains("1.00 M photons/s, 3.00 M rays/s"));
}

TEST_CASE("a note is printed once") {
  const std::string text = printed([](std::FILE* stream) {
    ProgressReport report(stream, false);
    report.note("one");
    report.note("one");
    report.note("");
    report.note("two");
  });
  CHECK(text == "causticl: note: one\ncausticl: note: two\n");
}

TEST_CASE("a quiet report prints nothing") {
  const std::string text = printed([](std::FILE* stream) {
    ProgressReport report(stream, true);
    report.note("one");
    report.update(progress_at(1, 1));
    report.finish({"a.png"}, example_statistics());
  });
  CHECK(text.empty());
}

TEST_CASE("the last line says what was written, the passes, the seconds and the reason") {
  Statistics statistics = example_statistics();
  statistics.stop = StopReason::time;
  const std::string text = printed([&](std::FILE* stream) {
    ProgressReport(stream, false).finish({"a.png", "b.exr"}, statistics);
  });
  CHECK(text == "causticl: wrote a.png, b.exr: 7 passes in 2.5 s (time limit reached)\n");
}

TEST_CASE("the error is told with its confidence and its parts, and is null where it is not known") {
  Statistics statistics = example_statistics();
  const auto last_lines = [&] {
    return printed([&](std::FILE* stream) { ProgressReport(stream, false).finish({"a.png"}, statistics); });
  };
  CHECK_THAT(last_lines(), !Contains("error"));
  CHECK(nlohmann::json::parse(statistics_json(statistics))["error"].is_null());
  CHECK_THAT(statistics_table(statistics), !Contains("error"));
  statistics.error = PictureError{0.021, 0.018, 0.0092};
  statistics.confidence = 0.95;
  statistics.stop = StopReason::error;
  CHECK_THAT(last_lines(),
             Contains("(error reached)\n") &&
                 Contains("causticl: error 2.1% or less in 95% of the pixels (noise alone 1.8%, "
                          "bias alone 0.92%), 700 photons\n"));
  const auto object = nlohmann::json::parse(statistics_json(statistics));
  CHECK(object["error"] == 0.021);
  CHECK(object["error_noise"] == 0.018);
  CHECK(object["error_bias"] == 0.0092);
  CHECK(object["confidence"] == 0.95);
  CHECK(object["stop"] == "error");
  CHECK_THAT(statistics_table(statistics), Contains("2.1% in 95% of the pixels"));
}

TEST_CASE("the table lists kernels by their share of the time") {
  const std::string table = statistics_table(example_statistics());
  CHECK_THAT(table, Contains("Example device") && Contains("75.0%") && Contains("25.0%"));
  CHECK(table.find("gather") < table.find("trace_photons"));
  CHECK_THAT(table, !Contains("warning"));
}

TEST_CASE("every kind of fault is counted in the table and the JSON, and warned about") {
  Statistics statistics = example_statistics();
  CHECK(diagnostic_warnings(statistics.diagnostics).empty());
  std::uint64_t count = 3;
  for (const auto& kind : diagnostic_kinds) statistics.diagnostics.*kind.count = count++;
  const std::string table = statistics_table(statistics);
  const auto object = nlohmann::json::parse(statistics_json(statistics));
  const auto warnings = diagnostic_warnings(statistics.diagnostics);
  REQUIRE(warnings.size() == std::size(diagnostic_kinds));
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    const std::string number = std::to_string(i + 3);
    CHECK_THAT(table, Contains(std::string(diagnostic_kinds[i].key) + " " + number));
    CHECK(object[diagnostic_kinds[i].key] == i + 3);
    CHECK_THAT(warnings[i], StartsWith(number + " "));
  }
}

TEST_CASE("the JSON of the statistics is one object with the promised keys") {
  const auto object = nlohmann::json::parse(statistics_json(example_statistics()));
  for (const char* key :
       {"device", "seconds", "first_pass_seconds", "kernel_build_seconds", "tree_build_seconds", "passes",
        "photons", "photons_per_second", "rays", "peak_memory_bytes", "bytes_per_pixel", "kernels"})
    CHECK(object.contains(key));
  CHECK(object["passes"] == 7);
  CHECK(object["stop"] == "passes");
  CHECK(object["kernels"] == nlohmann::json{{"gather", 90.0}, {"trace_photons", 30.0}});
  CHECK(object["kernel_launches"]["gather"] == 14);
}

TEST_CASE("a device name that is not UTF-8 does no harm to the JSON") {
  Statistics statistics = example_statistics();
  statistics.device = "bad \xff name";
  CHECK(nlohmann::json::parse(statistics_json(statistics)).contains("device"));
}

TEST_CASE("a scene's summary counts its objects and finds its emitters") {
  Scene scene = example_scene();
  scene.meshes.resize(1);
  scene.meshes[0].file = "bunny.obj";
  scene.meshes[0].positions = {{1, 2, 3}};
  scene.meshes[0].position_index.resize(12);
  scene.objects = {object_at(Object::Shape::mesh, {}), object_at(Object::Shape::mesh, {}),
                   object_at(Object::Shape::plane, {}), object_at(Object::Shape::sphere, {1, 2, 3})};
  scene.objects[0].mesh = scene.objects[1].mesh = 0;
  scene.objects[3].material = 1;
  scene.notices = {"look here"};
  const std::string text = scene_summary(scene);
  CHECK_THAT(text, Contains("320 x 200") && Contains("4: 2 meshes, 1 plane, 1 sphere"));
  CHECK_THAT(text, Contains("bunny.obj: 12 triangles, used 2 times") && Contains("1 diffuse, 1 glass"));
  CHECK_THAT(text, Contains("emitters    1\n  /objects/0: sphere, radiance (0, 3, 0)"));
  CHECK_THAT(text, Contains("field of view 90 degrees") && Contains("note        look here"));
  CHECK_THAT(text, Contains("bounds      (0, 1, 2) to (2, 3, 4)"));
}

TEST_CASE("a scene's summary bounds every shape as it is transformed") {
  Scene scene = example_scene();
  const auto bounds_of = [&](Object object) {
    scene.objects = {object};
    const std::string text = scene_summary(scene);
    const auto start = text.find("bounds ");
    return text.substr(start, text.find('\n', start) - start);
  };
  Object object = object_at(Object::Shape::sphere, {});
  object.radius = 2;
  object.transform = Transform::scale({1, 2, 3}).followed_by(Transform::shift({10, 0, 0}));
  CHECK_THAT(bounds_of(object), Contains("(8, -4, -6) to (12, 4, 6)"));
  object = object_at(Object::Shape::disk, {1, 1, 1});
  CHECK_THAT(bounds_of(object), Contains("(0, 0, 1) to (2, 2, 1)"));
  object = object_at(Object::Shape::rectangle, {1, 1, 1});
  CHECK_THAT(bounds_of(object), Contains("(0.5, 0.5, 1) to (1.5, 1.5, 1)"));
  object = object_at(Object::Shape::box, {0, 0, 0});
  object.size = {2, 4, 6};
  CHECK_THAT(bounds_of(object), Contains("(-1, -2, -3) to (1, 2, 3)"));
  object = object_at(Object::Shape::bezier, {0, 1, 0});
  object.points = {{1, 0}, {3, 2}, {0, 4}};
  CHECK_THAT(bounds_of(object), Contains("(-3, 1, -3) to (3, 5, 3)"));
  CHECK_THAT(bounds_of(object_at(Object::Shape::plane, {})), Contains("none: every object is infinite"));
}

TEST_CASE("devices are listed with what matters") {
  const auto devices = list_devices();
  if (devices.empty()) return;
  const std::string text = device_list(devices);
  CHECK_THAT(text, Contains("0: " + devices[0].name) && Contains(devices[0].platform_name));
  for (const char* key :
       {"type", "platform", "driver", "version", "compute units", "memory", "max allocation", "fp64"})
    CHECK_THAT(text, Contains(key));
}

TEST_CASE("limits of the command line replace the scene's where they apply, and say where they do not") {
  Scene scene = example_scene();
  Options options;
  options.passes = 3;
  options.photons = 5;
  options.samples = 9;
  apply_options(options, scene);
  CHECK(scene.renderer.passes == 3);
  CHECK(scene.renderer.photons == 5);
  CHECK(scene.renderer.samples == 64);
  REQUIRE(scene.notices.size() == 1);
  CHECK(scene.notices[0] == "--samples has no effect: it belongs to pt and this render uses sppm");
}

TEST_CASE("outputs are those of the command line, else the scene's, else named after it") {
  Scene scene = example_scene();
  Options options;
  options.scene = scene.file = "some/where/name.json";
  CHECK(output_files(options, scene) == std::vector<std::string>{"name.png"});
  scene.output = "of_scene.exr";
  CHECK(output_files(options, scene) == std::vector<std::string>{"of_scene.exr"});
  options.outputs = {"a.png", "b.pfm"};
  CHECK(output_files(options, scene) == options.outputs);
}

TEST_CASE("--threads says what it cannot do on a device") {
  Options options;
  DeviceInfo info;
  info.name = "Card";
  info.type = "gpu";
  info.compute_units = 4;
  CHECK(threads_notice(options, info).empty());
  options.threads = 2;
  CHECK(threads_notice(options, info) == "--threads has no effect: Card is not a CPU device");
  info.type = "cpu";
  CHECK(threads_notice(options, info).empty());
  options.threads = 5;
  CHECK(threads_notice(options, info) == "--threads 5: the device has 4 compute units, and all are used");
}
