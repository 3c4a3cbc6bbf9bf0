// `causticl compare` as a user meets it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catch2.hpp"
#include "image/image.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
using Catch::Contains;
using Catch::StartsWith;

TEST_CASE("compare prints its numbers, and writes them and a map") {
  const TemporaryFolder folder;
  write_picture(folder.path("a.exr"), {8, 4, std::vector<float>(96, 0.5f)}, {});
  write_picture(folder.path("b.pfm"), {8, 4, std::vector<float>(96, 0.4f)}, {});
  const auto run =
      run_causticl({"compare", "a.exr", "b.pfm", "--map", "map.png", "--json", "c.json"}, folder.path(""));
  CAPTURE(run.errors);
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.output,
             Contains("relative MSE         0.0625") && Contains("(+25.000%)") && Contains("mean FLIP"));
  const auto object = nlohmann::json::parse(std::ifstream(folder.path("c.json")));
  CHECK(object.at("rmse") == Approx(0.1));
  CHECK(object.at("flip") > 0.01);
  CHECK(std::filesystem::file_size(folder.path("map.png")) > 50);
}

TEST_CASE("what compare cannot read or write gets one line and exit code 2") {
  const TemporaryFolder folder;
  write_picture(folder.path("a.pfm"), {8, 4, std::vector<float>(96, 0.5f)}, {});
  write_picture(folder.path("b.pfm"), {4, 8, std::vector<float>(96, 0.5f)}, {});
  folder.write("text.exr", "no picture");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"a.pfm", "b.pfm"}, "a.pfm has 8x4 pixels, b.pfm has 4x8 pixels; expected two of one size"},
      {{"a.pfm", "missing.exr"}, "missing.exr"},
      {{"text.exr", "a.pfm"}, "text.exr"},
      {{"a.pfm"}, "REFERENCE"},
      {{"a.pfm", "a.pfm", "--map", "map.jpg"}, "expected a name that ends in .png, .exr or .pfm"},
      {{"a.pfm", "a.pfm", "--json", "no/such/c.json"}, "no/such"}};
  for (const auto& [words, part] : cases) {
    auto all = words;
    all.insert(all.begin(), "compare");
    const auto run = run_causticl(all, folder.path(""));
    CAPTURE(part, run.errors);
    CHECK(run.exit_code == 2);
    CHECK(run.output.empty());
    CHECK_THAT(run.errors, StartsWith("causticl: error: ") && Contains(part));
    CHECK(std::count(run.errors.begin(), run.errors.end(), '\n') == 1);
  }
}
