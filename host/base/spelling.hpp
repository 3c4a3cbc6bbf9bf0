// Words and names in text, and the name that somebody meant who mistyped it.
#pragma once

#include <string>
#include <vector>

namespace causticl {

/// In lower case, as far as ASCII goes.
std::string lower(std::string text);

/// Of `names` the one that is nearest to `text`, if it is near: three edits at most, in any case. Null where
/// none is.
const std::string* nearest_name(const std::string& text, const std::vector<std::string>& names);

/// "; did you mean X?" for the nearest name, empty where none is near.
std::string did_you_mean(const std::string& text, const std::vector<std::string>& names);

/// The words of a text that has spaces between them.
std::vector<std::string> words_of(const std::string& text);

/// The names with `separator` between them.
std::string joined(const std::vector<std::string>& names, const std::string& separator);

/// "render, devices or info".
std::string listed(const std::vector<std::string>& names);

/// "1 mesh", "3 meshes".
std::string counted(std::size_t number, const std::string& noun);

}  // namespace causticl
