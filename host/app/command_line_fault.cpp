#include "app/command_line_fault.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "base/spelling.hpp"

namespace causticl {
namespace {

std::vector<const CLI::App*> all_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : all_commands(app)) names.push_back(command->get_name());
  return listed(names);
}

/// "--passes", "-D", ...
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// What other renderers call an option of ours.
const std::map<std::string, std::string> words_elsewhere{
    {"--out", "--output"},      {"--spp", "--samples"},     {"--width", "--size"},
    {"--height", "--size"},     {"--resolution", "--size"}, {"--iterations", "--passes"},
    {"--nthreads", "--threads"}};

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

/// What to say of an option that `command` does not have: its name without typing errors, or whose it is.
std::string option_hint(const std::string& word, const CLI::App& command, const CLI::App& app) {
  // Of "--name=value" the name; with both hyphens also where one was left out.
  std::string name = word.substr(0, word.find('='));
  if (name.size() > 2 && name[1] != '-') name = "-" + name;
  for (const CLI::App* other : all_commands(app)) {
    const auto names = option_names(*other);
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    return other == &command ? "; did you mean " + name + "?"
                             : "; it belongs to `causticl " + other->get_name() + "`";
  }
  const auto known = option_names(command);
  const auto elsewhere = words_elsewhere.find(name);
  if (elsewhere != words_elsewhere.end() &&
      std::find(known.begin(), known.end(), elsewhere->second) != known.end())
    return "; did you mean " + elsewhere->second + "?";
  return did_you_mean(name, known);
}

/// What to say of a word that is no option and stands where none is expected.
std::string argument_hint(const std::string& word, const CLI::App& command) {
  const auto known = option_names(command);
  const bool writes = std::find(known.begin(), known.end(), "--output") != known.end();
  const bool is_picture = word.ends_with(".png") || word.ends_with(".exr") || word.ends_with(".pfm");
  return writes && is_picture ? "; did you mean -o " + word + "?" : "";
}

std::string unknown_command(const std::vector<std::string>& extras, const CLI::App& app) {
  if (extras.empty()) return "no command given; expected " + command_names(app);
  if (extras.front().ends_with(".json"))
    return "no command given; did you mean `causticl render " + extras.front() + "`?";
  std::vector<std::string> known = option_names(app);
  for (const CLI::App* command : all_commands(app)) known.push_back(command->get_name());
  return "unknown command or option " + extras.front() + "; expected " + command_names(app) +
         did_you_mean(extras.front(), known);
}

}  // namespace

std::string command_line_fault(const CLI::ParseError& error, const CLI::App& app) {
  std::string text = error.what();
  const auto commands = app.get_subcommands();
  const auto extras = app.remaining(true);
  const std::string option = text.substr(0, text.find(':'));
  const auto unknown = std::find_if(extras.begin(), extras.end(), is_option);
  if (commands.empty()) {
    text = unknown_command(extras, app);
  } else if (unknown != extras.end()) {
    // Before all else: the value of a mistyped option passes for a scene, or leaves none.
    text = "unknown option or argument " + *unknown + option_hint(*unknown, *commands.front(), app);
  } else if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
    text = "unknown option or argument " +
           (extras.empty() ? text : extras.front() + argument_hint(extras.front(), *commands.front()));
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    text = text.find("missing") != std::string::npos ? option + ": a value is missing"
                                                     : option + ": given more than once";
  }
  return text + " (see `causticl " + (commands.empty() ? "" : commands.front()->get_name() + " ") +
         "--help`)";
}

}  // namespace causticl
