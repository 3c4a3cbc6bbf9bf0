// The name that somebody meant who mistyped it.
#pragma once

#include <string>
#include <vector>

namespace causticl {

/// Of `names` the one that is nearest to `text`, if it is near: three edits at most, in any case. Null where
/// none is.
const std::string* nearest_name(const std::string& text, const std::vector<std::string>& names);

/// "; did you mean X?" for the nearest name, empty where none is near.
std::string did_you_mean(const std::string& text, const std::vector<std::string>& names);

}  // namespace causticl
