#include "opencl/kernel_sources.hpp"

#include <filesystem>
#include <set>
#include <sstream>
#include <vector>

#include "base/error.hpp"
#include "base/input_file.hpp"

namespace causticl {
namespace {

/// Kernels run as native code.
void refuse_if_open_to_all(const std::filesystem::path& path) {
  std::error_code missing;
  const auto permissions = std::filesystem::status(path, missing).permissions();
  if (!missing && (permissions & std::filesystem::perms::others_write) != std::filesystem::perms::none)
    throw UserError("--kernel-dir: all users may write to " + path.string() +
                    ", and its kernels would run as native code; chmod o-w makes it yours");
}

std::string read_source(const std::string& name, const std::string& kernel_dir) {
  if (kernel_dir.empty()) {
    const auto found = embedded_kernel_sources().find(name);
    if (found == embedded_kernel_sources().end()) throw UserError("kernel source " + name + ": no such file");
    return found->second;
  }
  const auto path = std::filesystem::path(kernel_dir) / name;
  refuse_if_open_to_all(kernel_dir);
  auto below = std::filesystem::path(kernel_dir);
  for (const auto& part : std::filesystem::path(name)) refuse_if_open_to_all(below /= part);
  try {
    return read_input(path.string(), "a kernel source", 16u << 20);
  } catch (const UserError& error) {
    throw UserError("--kernel-dir: " + std::string(error.what()) + "; expected a copy of the folder cl/");
  }
}

/// The names of all files that `pattern`, FOLDER/*.cl, stands for, in order; else the one that it is.
std::vector<std::string> files_of(const std::string& pattern, const std::string& kernel_dir) {
  const std::string ending = "*.cl";
  if (!pattern.ends_with("/" + ending)) return {pattern};
  const std::string folder = pattern.substr(0, pattern.size() - ending.size());
  std::set<std::string> names;
  const auto add = [&](const std::string& name) {
    if (name.starts_with(folder) && name.ends_with(".cl") && name.find('/', folder.size()) == name.npos)
      names.insert(name);
  };
  if (kernel_dir.empty()) {
    for (const auto& source : embedded_kernel_sources()) add(source.first);
  } else {
    std::error_code missing;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(kernel_dir) / folder, missing))
      add(folder + entry.path().filename().string());
  }
  if (names.empty()) throw UserError("kernel sources " + pattern + ": no such files");
  return {names.begin(), names.end()};
}

/// Whether the line begins with `directive` of the preprocessor.
bool is_directive(const std::string& line, const std::string& directive) {
  return line.rfind("#" + directive, 0) == 0;
}

/// Appends `text` to `out`, and what it includes in place of the directives. An include under a condition is
/// refused: each file is included once, where it comes up first, whatever the conditions there say.
void append_flat(std::string& out, const std::string& name, const std::string& text,
                 const std::string& kernel_dir, std::set<std::string>& seen) {
  std::istringstream in(text);
  std::string line;
  int conditions = 0;
  out += "#line 1 \"" + name + "\"\n";
  for (int number = 1; std::getline(in, line); ++number) {
    constexpr const char* include = "#include \"";
    const auto end = line.rfind('"');
    if (is_directive(line, "if")) ++conditions;
    if (is_directive(line, "endif")) --conditions;
    if (is_directive(line, "pragma once")) line.clear();
    if (line.rfind(include, 0) != 0 || end < 10) {
      out += line + "\n";
      continue;
    }
    if (conditions > 0)
      throw UserError("kernel source " + name + ":" + std::to_string(number) +
                      ": an include under a condition; put the condition into the file");
    for (const std::string& included : files_of(line.substr(10, end - 10), kernel_dir))
      if (seen.insert(included).second)
        append_flat(out, included, read_source(included, kernel_dir), kernel_dir, seen);
    out += "#line " + std::to_string(number + 1) + " \"" + name + "\"\n";
  }
}

}  // namespace

std::string flatten_kernel_source(const std::string& file, const std::string& kernel_dir) {
  std::string out;
  std::set<std::string> seen{file};
  append_flat(out, file, read_source(file, kernel_dir), kernel_dir, seen);
  return out;
}

std::string flatten_kernel_text(const std::string& text, const std::string& kernel_dir) {
  std::string out;
  std::set<std::string> seen;
  append_flat(out, "inline", text, kernel_dir, seen);
  return out;
}

}  // namespace causticl
