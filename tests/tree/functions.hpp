// The functions of a file of C++ or OpenCL C, as far as their size and parameters go. No compiler: braces and
// parentheses of a text without comments, strings and preprocessor lines.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

namespace causticl {

struct FunctionSize {
  std::string name;
  int line, lines, parameters;
};

/// Spaces in place of comments, strings, characters and preprocessor lines; line ends stay.
inline std::string code_alone(const std::string& text) {
  std::string code = text;
  const auto blank = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < std::min(to, code.size()); ++i)
      if (code[i] != '\n') code[i] = ' ';
    return std::min(to, code.size());
  };
  bool begins_line = true;
  for (std::size_t i = 0; i < code.size();) {
    const auto after = [&](const std::string& end, std::size_t from) {
      const auto at = text.find(end, from);
      return at == text.npos ? text.size() : at + end.size();
    };
    if (text.compare(i, 2, "//") == 0) {
      i = blank(i, after("\n", i) - 1);
    } else if (text.compare(i, 2, "/*") == 0) {
      i = blank(i, after("*/", i + 2));
    } else if (text.compare(i, 2, "R\"") == 0 && text.find('(', i) != text.npos) {
      const auto open = text.find('(', i);
      i = blank(i, after(")" + text.substr(i + 2, open - i - 2) + "\"", open));
    } else if (text[i] == '"' ||
               (text[i] == '\'' && !(i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
      i = blank(i, end + 1);
    } else if (begins_line && text[i] == '#') {
      std::size_t end = after("\n", i);
      while (end >= 2 && end < text.size() && text[end - 2] == '\\') end = after("\n", end);
      i = blank(i, end);
      continue;
    } else {
      if (text[i] == '\n')
        begins_line = true;
      else if (text[i] != ' ')
        begins_line = false;
      ++i;
      continue;
    }
    begins_line = false;
  }
  return code;
}

/// How many arguments are between `from`, behind a parenthesis, and its end; where that is, in *end.
inline int count_parameters(const std::string& code, std::size_t from, std::size_t* end) {
  int depth = 0, commas = 0;
  bool any = false;
  std::size_t i = from;
  for (; i < code.size(); ++i) {
    const char c = code[i];
    if (c == ')' && depth == 0) break;
    if (c == '(' || c == '<' || c == '{' || c == '[') ++depth;
    if (c == ')' || c == '>' || c == '}' || c == ']') --depth;
    if (c == ',' && depth == 0) ++commas;
    any = any || !std::isspace(static_cast<unsigned char>(c));
  }
  *end = i;
  const std::string inside = code.substr(from, i - from);
  const bool is_void = inside.find_first_not_of(" \n") != inside.npos &&
                       inside.substr(inside.find_first_not_of(" \n"), 4) == "void" && commas == 0 &&
                       inside.find('*') == inside.npos && inside.size() < 8;
  return any && !is_void ? commas + 1 : 0;
}

/// The head of a function, "static int f(int a) const", taken apart; an empty name where it is none.
struct FunctionHead {
  std::string name;
  std::size_t parameters = 0;  // where they begin
};

inline FunctionHead function_head(const std::string& head) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  // The last pair of parentheses before the initialisers of members; nothing is assigned outside of it.
  std::size_t open = head.npos, close = head.npos;
  int depth = 0;
  for (std::size_t i = 0; i < head.size(); ++i) {
    const char c = head[i];
    if (c == '(' && depth++ == 0) open = i;
    if (c == ')' && --depth == 0) close = i;
    if (depth != 0) continue;
    if (c == '=' && head.find("operator") == head.npos) return {};
    const bool colon =
        c == ':' && i > 0 && head[i - 1] != ':' && (i + 1 == head.size() || head[i + 1] != ':');
    if (colon && close != head.npos) break;
  }
  if (open == head.npos || close == head.npos) return {};
  std::size_t end = open;
  while (end > 0 && head[end - 1] == ' ') --end;
  std::size_t begin = end;
  while (begin > 0 && is_word(head[begin - 1])) --begin;
  std::string name = head.substr(begin, end - begin);
  if (name.empty() && head.find("operator") != head.npos) name = "operator";
  for (const char* statement : {"if", "for", "while", "switch", "catch"})
    if (name == statement) return {};
  return {name, open + 1};
}

/// Functions with a body, outermost ones: lambdas and classes within them count as theirs.
inline std::vector<FunctionSize> functions_of(const std::string& text) {
  const std::string code = code_alone(text);
  const auto line_of = [&](std::size_t at) {
    return 1 +
           static_cast<int>(std::count(code.begin(), code.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  };
  std::vector<FunctionSize> found;
  std::size_t statement = 0;  // where what stands before a brace begins
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] == ';' || code[i] == '}') statement = i + 1;
    if (code[i] != '{') continue;
    const std::string head = code.substr(statement, i - statement);
    const auto [name, parameters] = function_head(head);
    if (name.empty()) {
      statement = i + 1;  // a namespace or a class, whose members follow; or a list of values
      continue;
    }
    std::size_t last = i, end = 0;
    for (int depth = 0; last + 1 < code.size(); ++last) {
      depth += (code[last] == '{') - (code[last] == '}');
      if (depth == 0) break;
    }
    const int first_line = line_of(statement + head.find_first_not_of(" \n"));
    found.push_back({name, first_line, 1 + line_of(last) - first_line,
                     count_parameters(code, statement + parameters, &end)});
    i = last;
    statement = last + 1;
  }
  return found;
}

}  // namespace causticl
