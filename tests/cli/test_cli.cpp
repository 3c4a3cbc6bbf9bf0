// The command line as a user meets it: help, errors, exit codes, and the commands that render nothing.
#include "catch2.hpp"

#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

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
                           "--time TIME", "--size WxH", "--seed N", "--device SPEC", "--threads N",
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
      {{},
       "no command given; expected render, merge, devices, info, explain, compare, study, selftest or schema "
       "(see "
       "`causticl "
       "--help`)"},
      {{"paint"},
       "unknown command or option paint; expected render, merge, devices, info, explain, compare, study, "
       "selftest or schema"},
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
      {{"render", "a.json", "--time", "0"},
       "--time: expected a positive time in seconds, or as in 90s, 10m or 1h30m, found '0'"},
      {{"render", "a.json", "--time", "-1"}, "--time: expected a positive time in seconds"},
      {{"render", "a.json", "--time", "nan"}, "--time: expected a positive time in seconds"},
      {{"render", "a.json", "--time", "soon"}, "--time: expected a positive time in seconds"},
      {{"render", "a.json", "--error", "0"}, "--error: expected a share between 0 and 1000%, as in 2%"},
      {{"render", "a.json", "--error", "-1%"}, "found '-1%'"},
      {{"render", "a.json", "--error", "%"}, "found '%'"},
      {{"render", "a.json", "--error", "2 %"}, "found '2 %'"},
      {{"render", "a.json", "--error", "nan"}, "found 'nan'"},
      {{"render", "a.json", "--confidence", "100%"},
       "--confidence: expected a share between 0 and 100%, as in 95% or 0.95, found '100%'"},
      {{"render", "a.json", "--confidence", "2"}, "found '2'; write 2% or 0.02"},
      {{"render", "a.json", "--confidence", "95"}, "found '95'; write 95% or 0.95"},
      {{"render", "a.json", "--error", "2"},
       "--error: expected a share between 0 and 1000%, as in 2% or 0.02, found '2'; write 2% or 0.02"},
      {{"render", "a.json", "--error=1"}, "found '1'; write 1% or 0.01"},
      {{"render", "a.json", "--error", "150"}, "found '150'; write 150% ("},
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
      {{"rendr", "a.json"},
       "unknown command or option rendr; expected render, merge, devices, info, explain, compare, "
       "study, selftest or schema; did you mean render?"},
      {{"Info", "a.json"}, "did you mean info?"},
      {{"--versoin"}, "did you mean --version?"},
      {{"render", "a.json", "--pases", "3"},
       "unknown option or argument --pases; did you mean --passes? (see `causticl render --help`)"},
      {{"render", "--pases", "3"}, "unknown option or argument --pases; did you mean --passes?"},
      {{"render", "a.json", "--pases=3"}, "unknown option or argument --pases=3; did you mean --passes?"},
      {{"render", "a.json", "-passes", "3"}, "did you mean --passes?"},
      {{"render", "a.json", "--Quiet"}, "did you mean --quiet?"},
      {{"render", "a.json", "--spp", "16"}, "unknown option or argument --spp; did you mean --samples?"},
      {{"render", "a.json", "--width", "16"}, "did you mean --size?"},
      {{"render", "a.json", "--out", "a.png"}, "did you mean --output?"},
      {{"render", "a.json", "b.png"}, "unknown option or argument b.png; did you mean -o b.png?"},
      {{"a.json"}, "no command given; did you mean `causticl render a.json`?"},
      {{"info", "a.json", "--passes", "3"},
       "unknown option or argument --passes; it belongs to `causticl render`"},
      {{"compare", "a.pfm", "b.pfm", "--mpa", "c.png"}, "did you mean --map?"},
      {{"study", "a.json", "--paramters", "alpha"}, "did you mean --parameters?"},
      {{"selftest", "--quik"}, "did you mean --quick?"},
      {{"render", "a.json", "--integrator", "pathh"}, "found 'pathh'; did you mean path?"},
      {{"render", "a.json", "--precision", "duoble"}, "found 'duoble'; did you mean double?"},
      {{"render", "a.json", "--triangle-test", "watertigth"}, "did you mean watertight?"},
      {{"study", "a.json", "--budget", "5x"}, "--budget: expected a positive time in seconds"},
      {{"render", "a.json", "\033[31mX"}, "unknown option or argument ?[31mX"},
      {{"render", "a.json", "--\033]0;x\a"}, "unknown option or argument --?]0;x?"},
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
