// What README shows must be there.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

TEST_CASE("every file that README links to exists") {
  const std::string root = std::string(CAUSTICL_SOURCE_DIR) + "/";
  std::ifstream in(root + "README.md");
  REQUIRE(in);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::regex link(R"(\]\(([^)#]+)\))"), script(R"((scripts/[a-z_]+\.(sh|py)))");
  int links = 0;
  for (const auto& pattern : {link, script})
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
      const std::string target = (*match)[1];
      if (target.rfind("http", 0) == 0) continue;
      INFO(target);
      CHECK(std::filesystem::exists(root + target));
      ++links;
    }
  CHECK(links > 10);
}
