#include "base/spelling.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <numeric>
#include <sstream>

namespace causticl {
namespace {

// Optimal string alignment distance: insertions, deletions, replacements, swaps of neighbours.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last(b.size() + 1), current(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    before = last;
    last = current;
  }
  return last[b.size()];
}

}  // namespace

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

const std::string* nearest_name(const std::string& text, const std::vector<std::string>& names) {
  // Three edits find nothing in a text that is far longer than any name; do not even compare it.
  const std::string* best = nullptr;
  std::size_t best_distance =
      std::min<std::size_t>({text.size(), 4, 1 + std::max<std::size_t>(1, text.size() / 3)});
  for (const std::string& name : names) {
    if (text.size() > name.size() + 3) continue;
    const std::size_t distance = edit_distance(lower(text), lower(name));
    if (distance >= best_distance) continue;
    best = &name;
    best_distance = distance;
  }
  return best;
}

std::string did_you_mean(const std::string& text, const std::vector<std::string>& names) {
  const std::string* best = nearest_name(text, names);
  return best ? "; did you mean " + *best + "?" : "";
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

std::string joined(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : separator) + names[i];
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

std::string counted(std::size_t number, const std::string& noun) {
  const char* ending = number == 1                                                      ? ""
                       : noun.back() == 'h' || noun.back() == 'x' || noun.back() == 's' ? "es"
                                                                                        : "s";
  return std::to_string(number) + " " + noun + ending;
}

}  // namespace causticl
