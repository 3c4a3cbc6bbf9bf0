// The page of a study, without a browser: scripts/study_page.sh has one.
#include "study/study_page.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "../temporary_folder.hpp"
#include "catch2.hpp"
#include "image/image.hpp"
#include "study/study_insets.hpp"
#include "study_fixture.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

Picture grey(int width, int height, float value) {
  return {width, height, std::vector<float>(static_cast<std::size_t>(3 * width * height), value)};
}

std::string page_of(const Study& study) {
  const TemporaryFolder folder;
  write_picture(folder.path("reference.exr"), grey(study.width, study.height, 0.5f), {});
  write_study_page(folder.path(""), study, analyse(study));
  std::ifstream in(folder.path("study.html"));
  return {std::istreambuf_iterator<char>(in), {}};
}

nlohmann::json data_of(const std::string& page) {
  const std::string start = "<script type=\"application/json\" id=\"data\">";
  const auto begin = page.find(start) + start.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

}  // namespace

TEST_CASE("the page holds the numbers of the CSV") {
  Study study = made_study();
  study.device = "</script><b>device";
  const std::string page = page_of(study);
  const auto data = data_of(page);
  std::istringstream csv(study_csv(study));
  std::string line;
  std::getline(csv, line);
  for (const auto& run : data.at("study").at("runs"))
    for (const auto& sample : run.at("samples")) {
      REQUIRE(std::getline(csv, line));
      std::vector<std::string> cells{""};
      for (const char c : line)
        if (c == ',')
          cells.emplace_back();
        else
          cells.back() += c;
      REQUIRE(cells.size() == 12);
      CHECK(cells[0] == run.at("knob").get<std::string>());
      CHECK(cells[1] == run.at("value").get<std::string>());
      CHECK(std::stod(cells[4]) == sample.at("passes").get<double>());
      CHECK(std::stod(cells[6]) == sample.at("seconds").get<double>());
      CHECK(std::stod(cells[7]) == sample.at("relative_mse").get<double>());
      CHECK(std::stod(cells[9]) == sample.at("error_90").get<double>());
    }
  CHECK_FALSE(std::getline(csv, line));
  CHECK(data.at("study").at("device") == study.device);
  CHECK(data.at("analysis").at("settings").size() == 3);
  CHECK(data.at("knobs").size() == 2);
}

TEST_CASE("the page needs nothing but itself") {
  const std::string page = page_of(made_study());
  for (const char* const outside : {"src=\"http", "href=\"http", "@import", "url(http", "fetch(",
                                    "/* data */", "/* style */", "/* plot */", "/* script */"})
    CHECK_THAT(page, !Contains(outside));
  CHECK_THAT(page, Contains("data:image/png;base64,iVBOR"));
}

TEST_CASE("settings that were never rendered are said to be left out") {
  Study study = made_study();
  study.runs.erase(study.runs.begin() + 2);
  study.runs.pop_back();
  const auto left_out = data_of(page_of(study)).at("study").at("left_out");
  CHECK(left_out.size() == 2);
  CHECK_THAT(left_out[1].get<std::string>(), Contains("integrator=pt: no time"));
}

TEST_CASE("insets are where pictures differ, apart from each other and within the picture") {
  Picture reference = grey(40, 32, 0.2f), other = reference;
  for (const auto& [x0, y0] : {std::pair{3, 20}, std::pair{30, 4}})
    for (int y = y0; y < y0 + 5; ++y)
      for (int x = x0; x < x0 + 5; ++x) other.rgb[static_cast<std::size_t>(3 * (40 * y + x))] = 0.9f;
  const auto insets = choose_insets(reference, {other}, 2);
  REQUIRE(insets.size() == 2);
  int hits = 0;
  for (const auto& [x, y, size] : insets) {
    CHECK(x >= 0);
    CHECK(y >= 0);
    CHECK(x + size <= 40);
    CHECK(y + size <= 32);
    hits += x <= 3 && 8 <= x + size && y <= 20 && 25 <= y + size;
    hits += x <= 30 && 35 <= x + size && y <= 4 && 9 <= y + size;
  }
  CHECK(hits == 2);
  CHECK(choose_insets(grey(1, 1, 1), {grey(1, 1, 0)}, 3).size() == 1);
}

TEST_CASE("the summary says what to type and where the page is") {
  const Study study = made_study();
  const std::string text = study_summary(study, analyse(study), "out");
  CHECK_THAT(text, Contains("error 5%: 90% of pixels within 5% with integrator=pt") &&
                       Contains("--integrator pt --samples ") && Contains("wrote out/study.html"));
  Study poor = study;
  for (auto& run : poor.runs) run.samples.resize(1);
  CHECK_THAT(study_summary(poor, analyse(poor), "out"), Contains("no setting comes near"));
}
