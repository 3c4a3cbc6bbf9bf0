// The entry point of one fuzzer: libFuzzer calls it with each input.
#include <cstddef>
#include <cstdint>

#include "fuzz_targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const causticl::FuzzTarget& target = causticl::fuzz_target(CAUSTICL_FUZZ_TARGET);
  target.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
