// The program of a scene holds the code of an effect exactly where the scene calls for it: asserted on what
// the driver builds. A build in which that code calls a function that does not exist fails where the code is
// there.
#include "catch2.hpp"

#include "base/error.hpp"
#include "device_fixture.hpp"
#include "effect_scenes.hpp"
#include "effects/effects.hpp"
#include "opencl/kernels.hpp"
#include "render/render_fixture.hpp"

using namespace causticl;

namespace {

const std::string has = "#define HAS(effect) ((EFFECTS & (effect)) != 0u)\n";

/// What HAS() becomes: code that is there for `effect` alone, and for no other that was asked for with it,
/// calls what no program defines.
std::string poisoned(std::string source, unsigned effect) {
  const auto at = source.find(has);
  REQUIRE(at != std::string::npos);
  const std::string bit = std::to_string(effect) + "u";
  return source.replace(at, has.size(),
                        "int effect_is_there(void);\n"
                        "#define HAS(effect) ((EFFECTS & (effect)) != 0u && "
                        "((EFFECTS & (effect) & ~" +
                            bit + ") != 0u || effect_is_there()))\n");
}

/// Whether the program of `pass` for the scene holds code of the effect.
bool holds(const std::string& scene, const std::string& pass, unsigned effect) {
  const unsigned bits = effect_bits(find_effects(scene_from_text(scene))) & effects_of_pass(pass);
  const std::string source = "#define EFFECTS " + std::to_string(bits) + "u\n" +
                             flatten_kernel_source("passes/pass_" + pass + ".cl");
  try {
    test_device().build(poisoned(source, effect));
    return false;
  } catch (const DeviceError& error) {
    INFO(error.what());
    CHECK(std::string(error.what()).find("effect_is_there") != std::string::npos);
    return true;
  }
}

}  // namespace

TEST_CASE("a scene with an effect compiles it, and the same scene without does not") {
  for (const auto& [key, with, without, reason] : effect_scenes()) {
    const unsigned effect = chosen_effects(find_effects(Scene{}), key);
    int passes = 0;
    for (const char* pass : {"camera", "photon", "grid", "gather", "path"}) {
      if (!(effects_of_pass(pass) & effect)) continue;
      INFO(key << " in pass " << pass);
      CHECK(holds(with, pass, effect));
      CHECK(!holds(without, pass, effect));
      ++passes;
    }
    // What moves is placed anew by the host for each pass: no kernel knows of it.
    CHECK((passes > 0) == (key != "motion"));
  }
}
