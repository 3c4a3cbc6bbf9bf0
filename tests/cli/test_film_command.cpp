// Films on the command line: checkpoints that survive a kill, parts and crops that `merge` puts together.
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "catch2.hpp"
#include "film/film_file.hpp"
#include "process.hpp"
#include "render/film_fixture.hpp"
#include "small_render.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

const std::string scene = CAUSTICL_SOURCE_DIR "/scenes/cornell_box.json";

Words render(Words more) {
  Words words{"render", scene, "--size", "32x24", "--photons", "3000", "--quiet"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const Words global{"-D", "renderer.schedule=global", "-D", "renderer.boundary_correction=false"};

Words global_render(Words more) {
  more.insert(more.end(), global.begin(), global.end());
  return render(more);
}

Finished run(const Words& words, const TemporaryFolder& folder) {
  return Process(words, folder.path("")).wait();
}

void check_runs(const Words& words, const TemporaryFolder& folder) {
  const Finished done = run(words, folder);
  CAPTURE(words, done.errors);
  CHECK(done.exit_code == 0);
}

void check_refused(const Words& words, const TemporaryFolder& folder, const std::string& message) {
  const Finished done = run(words, folder);
  CAPTURE(words);
  CHECK(done.exit_code == 2);
  CHECK_THAT(done.errors, Contains(message));
  CHECK(std::count(done.errors.begin(), done.errors.end(), '\n') == 1);
}

}  // namespace

TEST_CASE("a render that is killed goes on from its checkpoint to the bits of one run") {
  TemporaryFolder folder;
  check_runs(render({"--passes", "200", "--film", "whole.film", "-o", "whole.pfm"}), folder);
  const FilmState whole = read_film(folder.path("whole.film"));
  RandomInputs random(321);
  for (int n = 0; n < 4; ++n) {
    CAPTURE(n, random.seed);
    fs::remove(folder.path("part.film"));
    // Killed once or twice, each time when some checkpoint is there.
    for (int kills = 0; kills < 1 + n % 2; ++kills) {
      Words words = render({"--passes", "100000", "-o", "part.pfm", "--every", "0.05"});
      if (kills == 0)
        words.insert(words.end(), {"--checkpoint", "part.film"});
      else
        words.insert(words.end(), {"--resume", "part.film"});
      Process process(words, folder.path(""));
      while (!fs::exists(folder.path("part.film"))) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      std::this_thread::sleep_for(std::chrono::milliseconds(random.engine() % 200));
      process.send(SIGKILL);
      CHECK(process.wait().signal == SIGKILL);
    }
    const std::uint64_t done = read_film(folder.path("part.film")).passes.count();
    CHECK(done > 0);
    const std::string passes = std::to_string(std::max<std::uint64_t>(200, done + 1));
    check_runs(render({"--passes", passes, "--resume", "part.film", "-o", "part.pfm"}), folder);
    const FilmState part = read_film(folder.path("part.film"));
    if (passes == "200") {
      check_same_film(part, whole);
      CHECK(bytes_of(folder.path("part.pfm")) == bytes_of(folder.path("whole.pfm")));
    }
    CHECK(part.passes.count() == std::stoull(passes));
    // What the killed runs left half written is gone.
    for (const auto& entry : fs::directory_iterator(folder.path("")))
      CHECK(entry.path().filename().string().front() != '.');
  }
}

TEST_CASE("merge puts passes and crops together, into a picture and a film") {
  TemporaryFolder folder;
  check_runs(global_render({"--passes", "6", "--film", "whole.film", "-o", "whole.exr"}), folder);
  check_runs(global_render({"--pass-range", "1:2", "--film", "a.film", "-o", "part.pfm"}), folder);
  check_runs(global_render({"--pass-range", "3:6", "--film", "b.film", "-o", "part.pfm"}), folder);
  check_runs({"merge", "b.film", "a.film", "-o", "merged.exr", "-o", "merged.png", "--film", "merged.film"},
             folder);
  check_same_film(read_film(folder.path("merged.film")), read_film(folder.path("whole.film")));
  const Picture whole = read_picture(folder.path("whole.exr")),
                merged = read_picture(folder.path("merged.exr"));
  CHECK(merged.rgb == whole.rgb);
  CHECK(fs::file_size(folder.path("merged.png")) > 100);
  for (const auto& channel : merged.channels) {
    const auto same = std::find_if(whole.channels.begin(), whole.channels.end(),
                                   [&](const Channel& other) { return other.name == channel.name; });
    REQUIRE(same != whole.channels.end());
    CHECK(same->values == channel.values);
  }
  // Devices of two kinds: their parts are merged and resumed, with a line.
  FilmState other = read_film(folder.path("a.film"));
  other.devices = {"another device"};
  write_film(folder.path("other.film"), other);
  CHECK_THAT(run({"merge", "other.film", "b.film", "-o", "merged.png"}, folder).errors,
             Contains("the bits are those of no single device"));
  const Finished resumed = run(Words{"render", scene, "--size", "32x24", "--photons", "3000", "--passes", "3",
                                     "--resume", "other.film", "-o", "part.pfm"} +
                                   global,
                               folder);
  CHECK_THAT(resumed.errors, Contains("of another device: the bits will be those of no single device"));
  CHECK(read_film(folder.path("other.film")).devices.size() == 2);

  const Finished said = run({"merge", "a.film", "b.film", "-o", "merged.png"}, folder);
  CHECK_THAT(said.errors, Contains("wrote merged.png: 6 passes") && Contains("of the pixels"));

  // Fractions round to pixels.
  check_runs(render({"--passes", "3", "--crop", "0.0,0.0,0.5,1.0", "--film", "left.film", "-o", "part.pfm"}),
             folder);
  check_runs(render({"--passes", "3", "--crop", "16,0,32,24", "--film", "right.film", "-o", "part.pfm"}),
             folder);
  check_runs({"merge", "left.film", "right.film", "--film", "both.film"}, folder);
  check_runs(render({"--passes", "3", "--film", "three.film", "-o", "part.pfm"}), folder);
  check_same_film(read_film(folder.path("both.film")), read_film(folder.path("three.film")));
  check_runs({"merge", "left.film", "right.film", "-o", "both.pfm"}, folder);
  check_runs(render({"--passes", "3", "-o", "three.pfm"}), folder);
  CHECK(bytes_of(folder.path("both.pfm")) == bytes_of(folder.path("three.pfm")));
}

TEST_CASE("the commands of docs/scale run, as they stand there") {
  const std::string page = bytes_of(CAUSTICL_SOURCE_DIR "/docs/scale.md");
  // At a small size; all else is that of the page.
  std::string script =
      "set -e\nln -s '" CAUSTICL_SOURCE_DIR
      "/scenes' scenes\ncausticl() {\n"
      "  if [ \"$1\" = render ]; then set -- \"$@\" --size 32x24 --photons 1000; fi\n  '" CAUSTICL_BINARY
      "' \"$@\" --quiet\n}\n";
  const std::string begin = "```sh\n";
  std::size_t blocks = 0;
  for (auto at = page.find(begin); at != page.npos; at = page.find(begin, at + 1), ++blocks)
    script += page.substr(at + begin.size(), page.find("```", at + begin.size()) - at - begin.size());
  CHECK(blocks == 4);
  TemporaryFolder folder;
  folder.write("run.sh", script);
  REQUIRE(std::system(("cd '" + folder.path("") + "' && sh run.sh").c_str()) == 0);
  CHECK(read_film(folder.path("glass.film")).passes == PassSet({0, 400}));
  CHECK(read_film(folder.path("whole.film")).passes == PassSet({0, 64}));
  CHECK(fs::file_size(folder.path("picture.exr")) > 1000);
}

TEST_CASE("a render that is killed at any of fifty moments goes on from its checkpoint", "[long]") {
  TemporaryFolder folder;
  check_runs(render({"--passes", "1500", "--film", "whole.film", "-o", "whole.pfm"}), folder);
  const FilmState whole = read_film(folder.path("whole.film"));
  RandomInputs random(322);
  for (int n = 0; n < 50; ++n) {
    CAPTURE(n, random.seed);
    fs::remove(folder.path("part.film"));
    Process process(
        render({"--passes", "1500", "-o", "part.pfm", "--every", "0.05", "--checkpoint", "part.film"}),
        folder.path(""));
    std::this_thread::sleep_for(std::chrono::milliseconds(random.engine() % 4000));
    process.send(SIGKILL);
    process.wait();
    const bool begun = fs::exists(folder.path("part.film"));
    check_runs(
        render({"--passes", "1500", begun ? "--resume" : "--checkpoint", "part.film", "-o", "part.pfm"}),
        folder);
    check_same_film(read_film(folder.path("part.film")), whole);
  }
}

TEST_CASE("options of films that do not go together, and files that are none, get one line") {
  TemporaryFolder folder;
  check_runs(render({"--passes", "2", "--checkpoint", "a.film", "-o", "a.pfm"}), folder);
  check_refused(render({"--passes", "2", "--checkpoint", "a.film"}), folder,
                "a.film: holds a film already; go on from it with --resume a.film");
  check_refused(render({"--resume", "none.film"}), folder, "none.film: no such file");
  check_refused(render({"--resume", scene}), folder, "is no film; expected a film");
  check_refused(render({"--resume", "a.film", "--seed", "2"}), folder,
                "a.film: is of another render (seed: 1 in the film, 2 in this command)");
  check_refused({"render", scene, "--size", "32x24", "--photons", "4000", "--resume", "a.film"}, folder,
                "(renderer: ");
  check_refused(render({"--resume", "a.film", "-D", "max_depth=3"}), folder, "(-D: none in the film");
  check_refused(render({"--resume", "a.film", "--crop", "0,0,5,5"}), folder, "holds the pixels 0,0,32,24");
  check_refused(render({"--pass-range", "3:4"}), folder, "--pass-range: a part is kept as a film");
  check_refused(render({"--pass-range", "4:3"}), folder, "expected A:B");
  check_refused(render({"--pass-range", "0:3"}), folder, "expected A:B");
  check_refused(render({"--pass-range", "3:4", "--film", "b.film"}), folder, "renderer.schedule=global");
  check_refused(render({"--crop", "0,0,33,24"}), folder, "reaches beyond the picture");
  check_refused(render({"--crop", "0.0,0.0,0.001,1.0"}), folder, "holds no pixel");
  for (const char* crop : {"1,2,3", "5,0,5,4", "0,0,-1,4", "a,b,c,d", "0.0,0.0,1.5,1.0"})
    check_refused(render({"--crop", crop}), folder, "expected x0,y0,x1,y1");
  check_refused(render({"--every", "5"}), folder, "expected --checkpoint FILE with it");
  check_refused(render({"--film", "b.film", "--checkpoint", "c.film"}), folder, "expected one of them");
  check_refused(render({"--film", "nowhere/b.film"}), folder, "there is no folder nowhere");
  check_refused(render({"--film", "./c.png", "-o", "c.png"}), folder,
                "cannot be both the film and a picture");
  folder.write("notes.txt", "not to be lost");
  check_refused(render({"--film", "notes.txt"}), folder, "is there already and is no film");
  check_refused({"merge", "a.film", "--film", "notes.txt"}, folder, "is there already and is no film");
  CHECK(bytes_of(folder.path("notes.txt")) == "not to be lost");
  // What is no file is written to as it is.
  check_runs(render({"--passes", "1", "--film", "/dev/null", "-o", "b.pfm"}), folder);
  CHECK(fs::is_character_file("/dev/null"));
  const Finished full = run(render({"--passes", "1", "--film", "/dev/full", "-o", "b.pfm"}), folder);
  CHECK(full.exit_code == 2);
  CHECK_THAT(full.errors, Contains("/dev/full: cannot be written: No space left on device"));
  CHECK(fs::is_character_file("/dev/full"));
  check_refused({"merge", "a.film"}, folder, "expected -o FILE for a picture, or --film FILE");
  check_refused({"merge", "a.film", "a.film", "-o", "b.png"}, folder, "expected each pass once");
  check_refused({"merge", scene, "-o", "b.png"}, folder, "is no film");
  CHECK_FALSE(fs::exists(folder.path("b.film")));
  CHECK_FALSE(fs::exists(folder.path("b.png")));

  // More passes of a scene without a wish for them: nothing is lost.
  const std::string before = bytes_of(folder.path("a.pfm"));
  check_runs(render({"--passes", "1", "--resume", "a.film", "-o", "b.pfm"}), folder);
  CHECK(bytes_of(folder.path("b.pfm")) == before);
}

TEST_CASE("files that are one by other names are not taken for two, nor are empty names for none") {
  TemporaryFolder folder;
  fs::create_directory(folder.path("below"));
  fs::create_directory_symlink("below", folder.path("linked"));
  fs::create_symlink("picture.pfm", folder.path("link.film"));
  check_runs(global_render({"--pass-range", "1:2", "--film", "first.film", "-o", "a.pfm"}), folder);
  check_runs(global_render({"--pass-range", "3:4", "--film", "second.film", "-o", "a.pfm"}), folder);
  fs::create_hard_link(folder.path("first.film"), folder.path("first.pfm"));
  const auto first = bytes_of(folder.path("first.film"));

  const Words some = render({"--passes", "2"});
  const auto with = [&](Words more) {
    more.insert(more.begin(), some.begin(), some.end());
    return more;
  };
  const std::string both = "cannot be both the film and a picture; expected two names";
  check_refused(with({"--film", folder.path("picture.pfm"), "-o", "picture.pfm"}), folder, both);
  check_refused(with({"--film", "link.film", "-o", "picture.pfm"}), folder, both);
  check_refused(with({"--film", "linked/a.pfm", "-o", "below/a.pfm"}), folder, both);
  check_refused(with({"--film", "a.film", "-o", "b.pfm", "--stats-json", "./a.film"}), folder,
                "cannot be both the film and the statistics; expected two names");
  check_refused({"merge", "first.film", "second.film", "-o", "first.pfm"}, folder,
                "cannot be both a picture and a part; expected two names");
  for (const char* option : {"--film", "--checkpoint", "--resume"})
    check_refused(with({option, "", "-o", "a.pfm"}), folder,
                  std::string(option) + ": expected FILE, found nothing");
  CHECK(bytes_of(folder.path("first.film")) == first);

  // The whole may take the place of a part.
  check_runs({"merge", "first.film", "second.film", "-o", "whole.pfm", "--film", "first.film"}, folder);
  CHECK(read_film(folder.path("first.film")).passes.count() == 4);
}

TEST_CASE("merged crops tell the error that the whole picture tells") {
  TemporaryFolder folder;
  const auto error_of = [&](const Words& words) {
    Words loud = words;
    std::erase(loud, "--quiet");
    const Finished done = run(loud, folder);
    CHECK(done.exit_code == 0);
    const auto at = done.errors.rfind("error ");
    REQUIRE(at != std::string::npos);
    return done.errors.substr(at, done.errors.find('\n', at) - at);
  };
  for (const char* integrator : {"pt", "sppm"}) {
    CAPTURE(integrator);
    const auto with = [&](Words more) {
      more.insert(more.end(),
                  {"--integrator", integrator, integrator[0] == 'p' ? "--samples" : "--passes", "8"});
      return render(more);
    };
    const std::string plain = error_of(with({"-o", "plain.pfm"}));
    check_runs(with({"--crop", "0,0,32,11", "--film", "upper.film", "-o", "a.pfm"}), folder);
    check_runs(with({"--crop", "0,11,17,24", "--film", "left.film", "-o", "a.pfm"}), folder);
    check_runs(with({"--crop", "17,11,32,24", "--film", "right.film", "-o", "a.pfm"}), folder);
    CHECK(error_of({"merge", "left.film", "upper.film", "right.film", "-o", "merged.pfm"}) == plain);
  }
}
