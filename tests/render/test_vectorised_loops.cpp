// Loops that are to become vector code do: PoCL's compiler tells of each that is marked and stays scalar, and
// a scene then takes up to twice as long without any other sign.
#include "catch2.hpp"

#include "cli/process.hpp"
#include "device_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

std::size_t times(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("the loops over photons and camera paths are vectorised") {
  if (!test_device().has_serial_work_items()) return;
  const TemporaryFolder folder;
  const std::string scenes = std::string(CAUSTICL_SOURCE_DIR) + "/scenes/";
  for (const char* scene : {"cornell_box", "glass_caustic", "7_sppm_room"}) {
    INFO(scene);
    Process process({"render", scenes + scene + ".json", "--integrator", "sppm", "--size", "16x12",
                     "--passes", "1", "--photons", "1000", "--output", folder.path("x.png")},
                    folder.path(""), Process::Stream::pipe,
                    {{"POCL_VECTORIZER_REMARKS", "1"}, {"CAUSTICL_CACHE_DIR", folder.path("cache")}});
    const Finished finished = process.wait();
    CHECK(finished.exit_code == 0);
    const std::string remarks = finished.output + finished.errors;
    if (remarks.find("vectorized loop") == std::string::npos) {
      WARN("this driver's compiler tells nothing of loops");
      return;
    }
    CHECK(times("loop not vectorized (Force=true", remarks) == 0);
    CHECK(times("unable to perform the requested transformation", remarks) == 0);
    // Compilers count them differently: PoCL 3.1 names more than ten, PoCL 6.0 nine.
    CHECK(times("vectorized loop (", remarks) > 5);
  }
}
