// What a render tells as it goes: a bar on a terminal, else lines.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

#include "app/progress.hpp"
#include "catch2.hpp"
#include "report_fixture.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

Progress progress_at(std::uint64_t pass, double seconds) {
  return {pass, 100, seconds, 10, {}, {}, pass * 1000000, pass * 3000000};
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("the progress bar never exceeds its width") {
  for (int width = 0; width < 200; ++width)
    CHECK(progress_bar(progress_at(25, 7), 1e6, 3e6, width).size() <= static_cast<std::size_t>(width));
}

TEST_CASE("the progress bar shows the fraction done and, where there is room, every number") {
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
