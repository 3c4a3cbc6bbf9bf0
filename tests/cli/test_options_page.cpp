// docs/cli.md names every option of every command where it belongs, and none that there is not.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <regex>
#include <set>

#include "app/options.hpp"
#include "catch2.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

using Names = std::set<std::string>;

const std::string page = bytes_of(CAUSTICL_SOURCE_DIR "/docs/cli.md");

/// What a heading of the page stands over, up to the next one of its level.
std::string section(const std::string& heading) {
  const auto begin = page.find("\n## " + heading + "\n");
  REQUIRE(begin != page.npos);
  return page.substr(begin, page.find("\n## ", begin + 1) - begin);
}

/// "--output" and "-o".
Names names_of(const CLI::Option& option) {
  Names names;
  for (const auto& name : option.get_lnames()) names.insert("--" + name);
  for (const auto& name : option.get_snames()) names.insert("-" + name);
  return names;
}

bool is_of_user(const CLI::Option& option) {
  return !names_of(option).empty() && option.get_name() != "--help";
}

/// All names of all options of a command.
Names options_of(const CLI::App& command) {
  Names names;
  for (const CLI::Option* option : command.get_options())
    if (is_of_user(*option)) names.merge(names_of(*option));
  return names;
}

/// The options of a command of which `described` holds no name.
Names undescribed(const CLI::App& command, const Names& described) {
  Names result;
  for (const CLI::Option* option : command.get_options()) {
    const Names names = names_of(*option);
    const bool found =
        std::any_of(names.begin(), names.end(), [&](const auto& name) { return described.contains(name); });
    if (is_of_user(*option) && !found) result.insert(option->get_name());
  }
  return result;
}

/// Of what stands in backticks in a text, the options.
Names options_in(const std::string& text) {
  static const std::regex option("`(--?[A-Za-z][a-z-]*)");
  Names names;
  for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

/// The first column, or all, of the rows of tables that begin with `start`.
std::string rows(const std::string& text, const std::string& start, bool first_column) {
  std::string result;
  for (auto at = text.find("\n| " + start); at != text.npos; at = text.find("\n| " + start, at + 1))
    result += text.substr(at, text.find(first_column ? " | " : "\n", at + 1) - at);
  return result;
}

Names beyond(const Names& names, const Names& known) {
  Names result;
  for (const auto& name : names)
    if (!known.contains(name)) result.insert(name);
  return result;
}

}  // namespace

TEST_CASE("the table of render has a row for every option, and no other") {
  Options options;
  const auto app = command_line(options);
  const CLI::App& render = *app->get_subcommand("render");
  const Names described = options_in(rows(section("render"), "`-", true));
  CHECK(undescribed(render, described) == Names{});
  CHECK(beyond(described, options_of(render)) == Names{});
}

TEST_CASE("the table of other commands has a row for each, with options of its own") {
  Options options;
  const auto app = command_line(options);
  const std::string others = section("Other commands");
  Names all;
  for (const CLI::App* command : app->get_subcommands([](const CLI::App*) { return true; })) {
    INFO(command->get_name());
    const Names declared = options_of(*command);
    all.insert(declared.begin(), declared.end());
    if (command->get_name() == "render") continue;
    const std::string row = rows(others, "`" + command->get_name(), false);
    CHECK(row != "");
    CHECK(beyond(options_in(row), declared) == Names{});
    CHECK(undescribed(*command, options_in(others)) == Names{});
  }
  all.insert({"--version", "--help"});
  CHECK(beyond(options_in(page), all) == Names{});
}

TEST_CASE("every option says what it does, and what it takes") {
  Options options;
  const auto app = command_line(options);
  for (const CLI::App* command : app->get_subcommands([](const CLI::App*) { return true; }))
    for (const CLI::Option* option : command->get_options()) {
      INFO(command->get_name() << " " << option->get_name());
      if (option->get_group().empty()) continue;  // a name that it had once
      CHECK(option->get_description().size() > 8);
      CHECK((option->get_items_expected_max() == 0 || option->get_positional() ||
             !option->get_type_name().empty()));
    }
}
