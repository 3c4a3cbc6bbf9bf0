// The binary as a user meets it: options, errors, exit codes, files, signals, progress.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "image.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

namespace {

using Words = std::vector<std::string>;
namespace fs = std::filesystem;

const std::string cornell_box = CAUSTICL_SOURCE_DIR "/scenes/cornell_box.json";
// An ICD loader that looks here finds no platform: what succeeds then, or fails otherwise, asked for no
// device.
const std::vector<std::pair<std::string, std::string>> no_device{{"OCL_ICD_VENDORS", "/nonexistent"}};

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A render of a fraction of a second on the device that the tests run on.
Words small_render(const Words& more = {}, const std::string& scene = cornell_box, int photons = 2000) {
  Words words{"render", scene, "--size", "16x12", "--photons", std::to_string(photons)};
  if (const char* device = std::getenv("CAUSTICL_DEVICE")) words = words + Words{"--device", device};
  return words + more;
}

// Far more passes than any test waits for.
const Words endless{"--passes", "1000000"};

std::string bytes_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// One line of error, and nothing else.
void check_one_error(const Finished& run, int exit_code, const std::string& part) {
  CAPTURE(run.errors);
  CHECK(run.exit_code == exit_code);
  CHECK(run.output.empty());
  CHECK_THAT(run.errors, StartsWith("causticl: error: ") && Contains(part) && EndsWith("\n"));
  CHECK(std::count(run.errors.begin(), run.errors.end(), '\n') == 1);
}

void check_success(const Finished& run) {
  CAPTURE(run.errors);
  REQUIRE(run.exit_code == 0);
}

}  // namespace

TEST_CASE("help mentions every command and option") {
  const TemporaryFolder folder;
  const auto help = [&](const Words& words) {
    const Finished run = run_causticl(words + Words{"--help"}, folder.path(""), no_device);
    CHECK(run.exit_code == 0);
    CHECK(run.errors.empty());
    return run.output;
  };
  for (const char* word : {"render", "devices", "info", "--help", "--version", "Exit codes"})
    CHECK_THAT(help({}), Contains(word));
  for (const char* word : {"SCENE", "-o,", "--integrator sppm|pt", "--passes N", "--photons N", "--samples N",
                           "--time SECONDS", "--size WxH", "--seed N", "--device SPEC", "--threads N",
                           "-D key=value", "--kernel-dir DIR", "--dump-kernels DIR", "--triangle-test TEST",
                           "--quiet", "--stats ", "--stats-json FILE", "Usage: causticl render"})
    CHECK_THAT(help({"render"}), Contains(word));
  for (const char* word : {"SCENE", "--integrator", "--size", "-D key=value"})
    CHECK_THAT(help({"info"}), Contains(word));
  CHECK_THAT(help({"devices"}), Contains("--device"));
}

TEST_CASE("--version prints name and number") {
  const TemporaryFolder folder;
  CHECK(run_causticl({"--version"}, folder.path(""), no_device).output == "causticl " CAUSTICL_VERSION "\n");
}

TEST_CASE("a command line that is not understood is one line of error and exit code 2") {
  const TemporaryFolder folder;
  const std::vector<std::pair<Words, std::string>> cases{
      {{}, "no command given; expected render, devices, info, compare or selftest (see `causticl --help`)"},
      {{"paint"}, "unknown command or option paint; expected render, devices, info, compare or selftest"},
      {{"--fast"}, "unknown command or option --fast"},
      {{"render"}, "SCENE is required (see `causticl render --help`)"},
      {{"info"}, "SCENE is required (see `causticl info --help`)"},
      {{"devices", "more"}, "unknown option or argument more"},
      {{"render", "a.json", "b.json"}, "unknown option or argument b.json"},
      {{"render", "a.json", "--fast"}, "unknown option or argument --fast"},
      {{"info", "a.json", "--passes", "3"}, "unknown option or argument --passes"},
      {{"render", "a.json", "--passes"}, "--passes: a value is missing"},
      {{"render", "a.json", "--passes", "-5"},
       "--passes: expected a whole number from 1 to 2147483647, found '-5'"},
      {{"render", "a.json", "--passes", "0"}, "--passes: expected a whole number from 1"},
      {{"render", "a.json", "--passes", "2.5"}, "found '2.5'"},
      {{"render", "a.json", "--passes", "99999999999"}, "found '99999999999'"},
      {{"render", "a.json", "--photons", "many"}, "--photons: expected a whole number from 1"},
      {{"render", "a.json", "--samples", "0"}, "--samples: expected a whole number from 1"},
      {{"render", "a.json", "--time", "0"}, "--time: expected a positive number of seconds, found '0'"},
      {{"render", "a.json", "--time", "-1"}, "--time: expected a positive number of seconds"},
      {{"render", "a.json", "--time", "nan"}, "--time: expected a positive number of seconds"},
      {{"render", "a.json", "--time", "soon"}, "--time: expected a positive number of seconds"},
      {{"render", "a.json", "--size", "640"}, "--size: expected WxH in pixels, as in 640x480"},
      {{"render", "a.json", "--size", "0x480"}, "--size: expected WxH in pixels"},
      {{"render", "a.json", "--size", "640x-480"}, "--size: expected WxH in pixels"},
      {{"render", "a.json", "--size", "640x480x2"}, "--size: expected WxH in pixels"},
      {{"render", "a.json", "--size", "640x70000"}, "each from 1 to 65536, found '640x70000'"},
      {{"render", "a.json", "--seed", "-1"}, "--seed: expected a whole number from 0 to 4294967295"},
      {{"render", "a.json", "--seed", "1", "--seed", "2"}, "--seed: given more than once"},
      {{"render", "a.json", "--threads", "0"}, "--threads: expected a whole number from 1"},
      {{"render", "a.json", "--integrator", "vcm"}, "--integrator: expected sppm or pt, found 'vcm'"},
      {{"render", "a.json", "--precision", "half"}, "--precision: expected float or double, found 'half'"},
      {{"render", "a.json", "--triangle-test", "precomputed", "--precision", "double"},
       "--triangle-test precomputed: its transforms are stored in single precision"},
      {{"render", "a.json", "--triangle-test", "fast"},
       "--triangle-test: expected watertight or precomputed, found 'fast'"},
      {{"render", "a.json", "--kernel-dir", "/nonexistent"}, "--kernel-dir: expected an existing folder"},
      {{"render", "a.json", "-D", "radius"},
       "-D: expected key=value, as in renderer.radius=0.1, found 'radius'"},
      {{"render", "a.json", "-D", "=3"}, "-D: expected key=value"},
      {{"render", "a.json", "-o"}, "--output: a value is missing"},
  };
  for (const auto& [words, part] : cases) {
    CAPTURE(words);
    check_one_error(run_causticl(words, folder.path(""), no_device), 2, part);
  }
}

TEST_CASE("faults of files are found before any device is asked for") {
  const TemporaryFolder folder;
  folder.write("broken.json", "{");
  const std::vector<std::pair<Words, std::string>> cases{
      {{"render", "missing.json"}, "missing.json"},
      {{"info", "missing.json"}, "missing.json"},
      {{"render", "broken.json"}, "broken.json"},
      {{"render", cornell_box, "-o", "picture.gif"}, "picture.gif"},
      {{"render", cornell_box, "-o", "good.png", "-o", "picture"}, "picture"},
      {{"render", cornell_box, "-o", "missing/picture.png"}, "missing/picture.png"},
      {{"render", cornell_box, "-o", "broken.json/picture.png"}, "broken.json/picture.png"},
      {{"render", cornell_box, "-o", "/proc/picture.png"}, "/proc/picture.png"},
      {{"render", cornell_box, "--stats-json", "missing/stats.json"}, "missing/stats.json"},
      {{"render", cornell_box, "--stats-json", "."}, "."},
      {{"render", cornell_box, "--stats-json", "/proc/stats.json"}, "/proc/stats.json"},
      {{"render", cornell_box, "-D", "wdith=3"}, "wdith"},
      {{"render", cornell_box, "-D", "width=-3"}, "/width"},
      {{"render", cornell_box, "-D", "objects.99.type=box"}, "objects"},
  };
  for (const auto& [words, part] : cases) {
    CAPTURE(words);
    check_one_error(run_causticl(words, folder.path(""), no_device), 2, part);
  }
  CHECK(names_in(folder.path("")) == Words{"broken.json"});
}

TEST_CASE("a machine without a device gets one helpful line and exit code 3") {
  const TemporaryFolder folder;
  for (const Words& words : {Words{"devices"}, Words{"render", cornell_box}})
    check_one_error(run_causticl(words, folder.path(""), no_device), 3, "pocl-opencl-icd");
}

TEST_CASE("an unknown device is the user's error and points at the list") {
  const TemporaryFolder folder;
  for (const char* device : {"99", "no such thing", "99999999999999999999"})
    check_one_error(run_causticl({"render", cornell_box, "--quiet", "--device", device}, folder.path("")), 2,
                    "causticl devices");
}

TEST_CASE("devices lists what --device takes") {
  const TemporaryFolder folder;
  const Finished run = run_causticl({"devices"}, folder.path(""));
  check_success(run);
  CHECK(run.errors.empty());
  for (const char* word :
       {"0: ", "type", "platform", "driver", "version", "compute units", "memory", "max allocation", "fp64"})
    CHECK_THAT(run.output, Contains(word));
}

TEST_CASE("info needs no device and shows the scene as the options change it") {
  const TemporaryFolder folder;
  const Finished run = run_causticl({"info", cornell_box, "--size", "64x48", "-D", "renderer.rounds=7"},
                                    folder.path(""), no_device);
  check_success(run);
  CHECK_THAT(run.output, Contains("64 x 48 pixels") && Contains("sppm: 7 passes"));
  CHECK_THAT(run.output, Contains("emitters    1\n") && Contains("bounds"));
  const Finished traced =
      run_causticl({"info", cornell_box, "--integrator", "pt"}, folder.path(""), no_device);
  CHECK_THAT(traced.output, Contains("integrator  pt: "));
}

TEST_CASE("a render writes the file that the scene names") {
  const TemporaryFolder folder;
  const Finished run = run_causticl(small_render({"--passes", "1"}), folder.path(""));
  check_success(run);
  CHECK(run.output.empty());
  CHECK(names_in(folder.path("")) == Words{"cornell_box.png"});
  const Image image = read_image(folder.path("cornell_box.png"), false);
  CHECK(image.width == 16);
  CHECK(image.height == 12);
  CHECK_THAT(run.errors, Contains("causticl: wrote cornell_box.png: 1 passes in ") && EndsWith("(done)\n"));
}

TEST_CASE("a scene without a path names the file after itself") {
  const TemporaryFolder folder;
  auto scene = nlohmann::json::parse(bytes_of(cornell_box), nullptr, true, true);
  scene.erase("path");
  const std::string file = folder.write("my box.json", scene.dump());
  check_success(run_causticl(small_render({"--passes", "1"}, file), folder.path("")));
  CHECK(names_in(folder.path("")) == Words{"my box.json", "my box.png"});
}

TEST_CASE("several outputs hold one picture") {
  const TemporaryFolder folder;
  const Words words{"--passes", "2", "-o", "a.png", "--output", "b.exr", "-o", "c.pfm"};
  check_success(run_causticl(small_render(words), folder.path("")));
  CHECK(names_in(folder.path("")) == Words{"a.png", "b.exr", "c.pfm"});
  const Picture exr = read_picture(folder.path("b.exr")), pfm = read_picture(folder.path("c.pfm"));
  CHECK(exr.rgb == pfm.rgb);
  CHECK(*std::max_element(pfm.rgb.begin(), pfm.rgb.end()) > 0);
}

TEST_CASE("the same seed gives the same bytes and another seed other ones") {
  const TemporaryFolder folder;
  for (const char* integrator : {"sppm", "pt"}) {
    const auto render = [&](const std::string& name, const Words& more) {
      const Words limit = integrator == std::string("pt") ? Words{"--samples", "2"} : Words{"--passes", "2"};
      const Words words = small_render(limit + Words{"--integrator", integrator, "-o", name} + more);
      check_success(run_causticl(words, folder.path("")));
      return bytes_of(folder.path(name));
    };
    const std::string first = render("a.pfm", {});
    CHECK(first.size() > 16 * 12 * 12);
    CHECK(render("b.pfm", {"--seed", "1"}) == first);
    CHECK(render("c.pfm", {"--threads", "1"}) == first);
    CHECK(render("d.pfm", {"--seed", "2"}) != first);
  }
}

TEST_CASE("--stats-json is one object whose numbers agree with the options") {
  const TemporaryFolder folder;
  const Finished run =
      run_causticl(small_render({"--passes", "3", "--stats-json", "stats.json"}), folder.path(""));
  check_success(run);
  CHECK(run.output.empty());
  CHECK(names_in(folder.path("")) == Words{"cornell_box.png", "stats.json"});
  const auto stats = nlohmann::json::parse(bytes_of(folder.path("stats.json")));
  CHECK_FALSE(stats.at("device").get<std::string>().empty());
  CHECK(stats.at("precision") == "float");
  CHECK(stats.at("passes") == 3);
  CHECK(stats.at("photons") == 6000);
  CHECK(stats.at("stop") == "passes");
  CHECK(stats.at("rays") > 6000);
  CHECK(stats.at("photons_per_second") > 0);
  CHECK(stats.at("bytes_per_pixel") > 0);
  CHECK(stats.at("peak_memory_bytes") > 1 << 20);
  CHECK(stats.at("emitters") >= 1);
  const double seconds = stats.at("seconds");
  CHECK(seconds > 0);
  CHECK(seconds < run.seconds);
  for (const char* key : {"first_pass_seconds", "kernel_build_seconds", "tree_build_seconds"}) {
    CHECK(stats.at(key) >= 0);
    CHECK(stats.at(key) <= seconds);
  }
  REQUIRE(stats.at("kernels").size() > 3);
  double milliseconds = 0;
  for (const auto& [kernel, time] : stats.at("kernels").items()) milliseconds += time.get<double>();
  CHECK(milliseconds > 0);
  CHECK(milliseconds < 1000 * seconds);
}

TEST_CASE("--stats prints a table to standard output, also when quiet") {
  const TemporaryFolder folder;
  const Finished run = run_causticl(small_render({"--passes", "1", "--stats", "--quiet"}), folder.path(""));
  check_success(run);
  CHECK(run.errors.empty());
  for (const char* word :
       {"device", "passes", "photons", "rays", "peak memory", "kernel", "launches", "share"})
    CHECK_THAT(run.output, Contains(word));
}

TEST_CASE("limits of the other integrator are said to have no effect") {
  const TemporaryFolder folder;
  const Finished run =
      run_causticl(small_render({"--integrator", "pt", "--samples", "3", "--passes", "5"}), folder.path(""));
  check_success(run);
  CHECK_THAT(run.errors,
             Contains("note: --passes has no effect: it belongs to sppm and this render uses pt"));
  CHECK_THAT(run.errors, Contains("note: --photons has no effect"));
  CHECK_THAT(run.errors, Contains("3 passes in "));
}

TEST_CASE("progress on a pipe is plain lines at powers of two") {
  const TemporaryFolder folder;
  const Finished run = run_causticl(small_render({"--passes", "6"}), folder.path(""));
  check_success(run);
  for (const char* line : {"causticl: pass 1/6, ", "causticl: pass 2/6, ", "causticl: pass 4/6, ",
                           "causticl: pass 6/6, ", " elapsed, ", " left, ", " photons/s, ", " rays/s\n"})
    CHECK_THAT(run.errors, Contains(line));
  CHECK_THAT(run.errors, !Contains("pass 3/6") && !Contains("pass 5/6"));
  CHECK_THAT(run.errors, !Contains("\r") && !Contains("\033"));
}

TEST_CASE("progress on a terminal is one bar within its width, cleared at the end") {
  const TemporaryFolder folder;
  for (const unsigned columns : {120u, 30u}) {
    Process process(small_render({"--passes", "4"}), folder.path(""), Process::Stream::terminal, {}, columns);
    const Finished run = process.wait();
    CAPTURE(run.errors);
    CHECK(run.exit_code == 0);
    const auto bar = run.errors.rfind("pass 4/4");
    REQUIRE(bar != std::string::npos);
    const auto start = run.errors.rfind('\r', bar), end = run.errors.find("\033[K", bar);
    REQUIRE(end != std::string::npos);
    CHECK(end - start - 1 < columns);
    CHECK((run.errors[start + 1] == '[') == (columns == 120));
    CHECK_THAT(run.errors, Contains("\033[K\r\033[Kcausticl: wrote cornell_box.png"));
  }
}

TEST_CASE("--quiet prints nothing at all") {
  const TemporaryFolder folder;
  const Finished run =
      run_causticl(small_render({"--passes", "2", "--quiet", "--threads", "9999"}), folder.path(""));
  check_success(run);
  CHECK(run.errors.empty());
  CHECK(run.output.empty());
}

TEST_CASE("SIGINT and SIGTERM finish the pass, write the image and exit with 130") {
  const TemporaryFolder folder;
  for (const int signal_number : {SIGINT, SIGTERM}) {
    Process process(small_render(endless + Words{"-o", "a.pfm", "-o", "b.png", "--stats-json", "stats.json"}),
                    folder.path(""));
    process.wait_for("pass 2/");
    process.send(signal_number);
    const Finished run = process.wait();
    CAPTURE(run.errors);
    CHECK(run.exit_code == 130);
    CHECK_THAT(run.errors, Contains("causticl: interrupted: finishing the pass") &&
                               Contains("causticl: wrote a.pfm, b.png: ") && EndsWith("(interrupted)\n"));
    CHECK(names_in(folder.path("")) == Words{"a.pfm", "b.png", "stats.json"});
    CHECK(read_picture(folder.path("a.pfm")).width == 16);
    CHECK(read_image(folder.path("b.png"), false).width == 16);
    CHECK(nlohmann::json::parse(bytes_of(folder.path("stats.json"))).at("stop") == "interrupted");
    fs::remove(folder.path("a.pfm"));
  }
}

TEST_CASE("an interrupted render is the same as one with as many passes") {
  const TemporaryFolder folder;
  Process process(small_render(endless + Words{"-o", "a.pfm", "--stats-json", "stats.json"}),
                  folder.path(""));
  process.wait_for("pass 2/");
  process.send(SIGINT);
  CHECK(process.wait().exit_code == 130);
  const int passes = nlohmann::json::parse(bytes_of(folder.path("stats.json"))).at("passes");
  check_success(
      run_causticl(small_render({"-o", "b.pfm", "--passes", std::to_string(passes)}), folder.path("")));
  CHECK(bytes_of(folder.path("a.pfm")) == bytes_of(folder.path("b.pfm")));
}

TEST_CASE("a second signal ends the process at once") {
  const TemporaryFolder folder;
  Process process(small_render({}, cornell_box, 500000), folder.path(""));
  process.wait_for("pass 1/");
  process.send(SIGINT);
  process.wait_for("interrupted");
  process.send(SIGINT);
  const Finished run = process.wait();
  // A fast device may be done with the pass before the second signal is there.
  if (run.exit_code == 130)
    WARN("the pass was too short to be stopped");
  else
    CHECK(run.signal == SIGINT);
}

TEST_CASE("--time ends the render in time") {
  const TemporaryFolder folder;
  // Once without a limit that counts, so that the kernels are compiled and cached.
  check_success(run_causticl(small_render({"--passes", "1"}), folder.path("")));
  const Finished run = run_causticl(
      small_render(endless + Words{"--time", "1.5", "--stats-json", "stats.json"}), folder.path(""));
  check_success(run);
  CHECK_THAT(run.errors, EndsWith("(time limit reached)\n"));
  const auto stats = nlohmann::json::parse(bytes_of(folder.path("stats.json")));
  CHECK(stats.at("stop") == "time");
  CHECK(stats.at("passes") >= 1);
  // Loosely: the machine may have other work to do, but all the passes would take a day.
  CHECK(stats.at("seconds") < 15);
}

TEST_CASE("--kernel-dir reads the kernels from a folder and --dump-kernels writes them") {
  const TemporaryFolder folder;
  const std::string kernels = CAUSTICL_SOURCE_DIR "/cl", dump = folder.path("dump");
  check_success(run_causticl(small_render({"--passes", "1", "-o", "a.pfm"}), folder.path("")));
  check_success(run_causticl(
      small_render({"--passes", "1", "-o", "b.pfm", "--kernel-dir", kernels, "--dump-kernels", dump}),
      folder.path("")));
  CHECK(bytes_of(folder.path("a.pfm")) == bytes_of(folder.path("b.pfm")));
  REQUIRE(fs::is_directory(dump));
  CHECK(std::distance(fs::directory_iterator(dump), {}) >= 3);

  fs::create_directory(folder.path("empty"));
  check_one_error(run_causticl(small_render({"--quiet", "--kernel-dir", "empty"}), folder.path("")), 2,
                  "empty");
}
