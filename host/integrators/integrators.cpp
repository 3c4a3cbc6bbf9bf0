#include "integrators/integrators.hpp"

#include "scene/integrators.hpp"

namespace causticl {
namespace {

struct IntegratorFunctions {
  std::unique_ptr<PassIntegrator> (*make)(const IntegratorInputs& in);
  ErrorRates (*rates)(const RendererSpec& renderer);
  std::string (*text)(const RendererSpec& renderer);
};

const IntegratorFunctions& functions_of(const RendererSpec& renderer) {
#define FUNCTIONS_OF_INTEGRATOR(name, ...) {make_##name, rates_of_##name, text_of_##name},
  static constexpr IntegratorFunctions functions[] = {INTEGRATOR_TABLE(FUNCTIONS_OF_INTEGRATOR)};
#undef FUNCTIONS_OF_INTEGRATOR
  return functions[static_cast<std::size_t>(renderer.integrator)];
}

}  // namespace

std::unique_ptr<PassIntegrator> make_integrator(const IntegratorInputs& in) {
  return functions_of(in.scene.renderer).make(in);
}

ErrorRates expected_rates(const RendererSpec& renderer) { return functions_of(renderer).rates(renderer); }

std::string integrator_text(const RendererSpec& renderer) { return functions_of(renderer).text(renderer); }

}  // namespace causticl
