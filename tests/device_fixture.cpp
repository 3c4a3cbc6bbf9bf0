#include "device_fixture.hpp"

#include <cstdlib>
#include <memory>

#include "base/error.hpp"

namespace causticl {

Device& test_device() {
  static const auto device = [] {
    const char* spec = std::getenv("CAUSTICL_DEVICE");
    if (spec) return std::make_unique<Device>(find_device(spec));
    try {
      return std::make_unique<Device>(find_device("cpu"));
    } catch (const UserError&) {
      return std::make_unique<Device>(find_device(""));
    }
  }();
  return *device;
}

cl::Program build_test_program(const std::string& text, unsigned effects, const std::string& options) {
  const std::string define = "#define EFFECTS " + std::to_string(effects) + "u\n";
  return test_device().build(define + flatten_kernel_text(text), options);
}

RandomInputs::RandomInputs(unsigned default_seed)
    : seed(std::getenv("CAUSTICL_TEST_SEED") ? std::strtoul(std::getenv("CAUSTICL_TEST_SEED"), nullptr, 10)
                                             : default_seed),
      engine(seed) {
  UNSCOPED_INFO("seed " << seed << " (CAUSTICL_TEST_SEED)");
}

}  // namespace causticl
