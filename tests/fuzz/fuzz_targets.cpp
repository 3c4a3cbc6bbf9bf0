#include "fuzz_targets.hpp"

namespace causticl {

const std::vector<FuzzTarget>& fuzz_targets() {
  static const std::vector<FuzzTarget> targets{
      {"scene", fuzz_scene}, {"override", fuzz_override}, {"obj", fuzz_obj}, {"ply", fuzz_ply},
      {"png", fuzz_png},     {"jpeg", fuzz_jpeg},         {"hdr", fuzz_hdr}, {"bmp", fuzz_bmp},
      {"tga", fuzz_tga},     {"pfm", fuzz_pfm},           {"exr", fuzz_exr}, {"kernels", fuzz_kernels},
      {"study", fuzz_study}, {"film", fuzz_film}};
  return targets;
}

const FuzzTarget& fuzz_target(const std::string& name) {
  for (const FuzzTarget& target : fuzz_targets())
    if (target.name == name) return target;
  throw std::out_of_range("no fuzz target " + name);
}

}  // namespace causticl
