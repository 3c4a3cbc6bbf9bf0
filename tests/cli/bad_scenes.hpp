// All scenes that must be refused.
#pragma once

#include <vector>

#include "bad_files.hpp"
#include "bad_lights.hpp"
#include "bad_materials.hpp"
#include "bad_objects.hpp"
#include "bad_settings.hpp"
#include "bad_syntax.hpp"

namespace causticl {

inline std::vector<BadScene> all_bad_scenes() {
  std::vector<BadScene> all;
  const auto add = [&](const auto& scenes) { all.insert(all.end(), std::begin(scenes), std::end(scenes)); };
  add(bad_syntax);
  add(bad_settings);
  add(bad_objects);
  add(bad_materials);
  add(bad_lights);
  add(bad_files);
  return all;
}

}  // namespace causticl
