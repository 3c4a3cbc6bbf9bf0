#include "selftest/selftest_check.hpp"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/error.hpp"
#include "opencl/kernel_sources.hpp"

namespace causticl {

cl::Program CheckContext::program(const std::string& text, unsigned effects,
                                  const std::string& options) const {
  const std::string define = "#define EFFECTS " + std::to_string(effects) + "u\n";
  return device.build(define + flatten_kernel_text(text, kernel_dir), options);
}

std::string replay_text(const std::uint32_t* words, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    const float value = std::bit_cast<float>(words[i]);
    char word[32];
    if (std::isfinite(value))
      std::snprintf(word, sizeof word, "%a", static_cast<double>(value));
    else
      std::snprintf(word, sizeof word, "#%08x", words[i]);
    if (i) text += ',';
    text += word;
  }
  return text;
}

std::vector<std::uint32_t> parse_replay(const std::string& text) {
  std::vector<std::uint32_t> words;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t last = std::min(text.find(',', first), text.size());
    const std::string word = text.substr(first, last - first);
    char* end = nullptr;
    if (!word.empty() && word[0] == '#')
      words.push_back(static_cast<std::uint32_t>(std::strtoul(word.c_str() + 1, &end, 16)));
    else
      words.push_back(std::bit_cast<std::uint32_t>(std::strtof(word.c_str(), &end)));
    if (word.empty() || *end != '\0')
      throw UserError("--replay: expected numbers separated by commas, as selftest prints them, found '" +
                      word + "'");
    first = last + 1;
  }
  return words;
}

const char* hard_case_name(int hard_case) {
  static constexpr const char* names[hard_case_count] = {
      "far or small sphere",
      "origin in, on or tangent to a sphere",
      "cracks between triangles",
      "precomputed triangles",
      "sliver and degenerate triangles",
      "slabs, flat boxes, axis-parallel rays",
      "KD-tree against brute force",
      "self-intersection",
      "scene moved or scaled",
      "revolved Bezier curves",
      "orthonormal basis",
      "Fresnel equations",
      "rough lobes",
      "energy",
      "shading normals",
      "long accumulation",
      "radius recursion",
      "SPPM statistics",
      "photon grid",
      "order of execution",
      "random numbers",
      "NaN and infinity",
      "sampling",
      "arithmetic of the device",
      "photons at bent shading normals",
      "dielectrics that touch or hold each other",
      "leaks through walls",
  };
  return names[hard_case - 1];
}

}  // namespace causticl
