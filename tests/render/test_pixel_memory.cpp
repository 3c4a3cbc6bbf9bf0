// Device memory that grows with the picture, and where visible points lie.
#include "catch2.hpp"

#include "device_fixture.hpp"
#include "render_fixture.hpp"
#include "shared/types.h"

using namespace causticl;

namespace {

RenderResult render_with(int photons, int visible_points) {
  Scene scene = shipped_scene("cornell_box.json", 64, 48);
  scene.renderer.integrator = Integrator::sppm;
  scene.renderer.passes = 2;
  scene.renderer.photons = photons;
  scene.renderer.visible_points = visible_points;
  return render_scene(scene, test_device(), {});
}

}  // namespace

TEST_CASE("visible points lie where photons were traced to, and cost nothing where that is large enough") {
  const double own = sizeof(FilmPixel) + sizeof(PixelStatistics) + sizeof(SppmPixel);
  CHECK(own <= 192);
  CHECK(render_with(20000, 4).statistics.bytes_per_pixel == own);
  // Room for two photons of each that is emitted: no more than a visible point needs here.
  CHECK(render_with(100, 4).statistics.bytes_per_pixel == own + 4 * sizeof(VisiblePoint));
}
