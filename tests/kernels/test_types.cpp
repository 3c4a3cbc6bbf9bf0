// The layout of every shared struct, as the device sees it and as the host does.
#include <cstddef>

#include "device_fixture.hpp"

using namespace causticl;

namespace {

struct Field {
  const char* type;
  const char* name;
  std::size_t offset;
};

#define FIELD(type, name) \
  { #type, #name, offsetof(type, name) }
const std::vector<Field> fields{
    FIELD(Camera, origin),
    FIELD(Camera, axis),
    FIELD(Camera, right),
    FIELD(Camera, up),
    FIELD(Camera, lens_right),
    FIELD(Camera, lens_up),
    FIELD(Material, color),
    FIELD(Material, emission),
    FIELD(Material, eta),
    FIELD(Material, k),
    FIELD(Material, absorption),
    FIELD(Material, kind),
    FIELD(Material, flags),
    FIELD(Material, color_texture),
    FIELD(Material, alpha),
    FIELD(Texture, a),
    FIELD(Texture, b),
    FIELD(Texture, scale),
    FIELD(Texture, kind),
    FIELD(Texture, bilinear),
    FIELD(Texture, first_texel),
    FIELD(Texture, width),
    FIELD(Texture, height),
    FIELD(Shape, sphere),
    FIELD(Shape, to_world),
    FIELD(Shape, to_local),
    FIELD(Shape, type),
    FIELD(Shape, material),
    FIELD(Shape, curve),
    FIELD(Shape, degree),
    FIELD(KdNode, bounds),
    FIELD(KdNode, child),
    FIELD(KdNode, block_count),
    FIELD(KdNode, parent),
    FIELD(KdNode, slot),
    FIELD(KdNode, extent),
    FIELD(TriangleBlock, position),
    FIELD(TriangleBlock, primitive),
    FIELD(TriangleTransforms, row),
    FIELD(TriangleTransforms, axis),
    FIELD(TriangleAttributes, uv),
    FIELD(TriangleAttributes, normal),
    FIELD(TriangleAttributes, material),
    FIELD(Emitter, a),
    FIELD(Emitter, b),
    FIELD(Emitter, c),
    FIELD(Emitter, radiance),
    FIELD(Emitter, cdf),
    FIELD(Emitter, probability),
    FIELD(Emitter, type),
    FIELD(Emitter, two_sided),
    FIELD(Emitter, shape),
    FIELD(Emitter, first_area),
    FIELD(Emitter, in_dielectric),
    FIELD(EnvironmentTexel, radiance),
    FIELD(EnvironmentTexel, density),
    FIELD(EnvironmentTexel, cdf),
    FIELD(Params, camera),
    FIELD(Params, width),
    FIELD(Params, height),
    FIELD(Params, first_pixel),
    FIELD(Params, pixel_count),
    FIELD(Params, seed),
    FIELD(Params, pass),
    FIELD(Params, visible_points),
    FIELD(Params, max_depth),
    FIELD(Params, plane_count),
    FIELD(Params, emitter_count),
    FIELD(Params, emitter_density),
    FIELD(Params, photon_flux),
    FIELD(Params, photon_count),
    FIELD(Params, photon_capacity),
    FIELD(Params, alpha),
    FIELD(Params, indirect_radius),
    FIELD(Params, emission_met),
    FIELD(Params, photon_role),
    FIELD(Params, photon_mutations),
    FIELD(Params, sobol),
    FIELD(Params, coverage),
    FIELD(Params, nested),
    FIELD(Params, contact_low),
    FIELD(Params, contact_high),
    FIELD(Params, inside_direction),
    FIELD(Params, first_photon),
    FIELD(Params, radius2),
    FIELD(Params, shadow_rays),
    FIELD(Params, delta_lights),
    FIELD(Params, inverse_wavelength2),
    FIELD(Params, segment),
    FIELD(Params, extinction),
    FIELD(Params, scattering),
    FIELD(Params, channel_shifts),
    FIELD(SppmPixel, radius2_hi),
    FIELD(SppmPixel, radius2_lo),
    FIELD(SppmPixel, photons_low),
    FIELD(SppmPixel, photons_high),
    FIELD(SppmPixel, coverage),
    FIELD(FilmPixel, sum),
    FIELD(FilmPixel, low),
    FIELD(FilmPixel, left_out),
    FIELD(FilmPixel, m2_deviation),
    FIELD(FilmPixel, kernel_bias),
    FIELD(FilmPixel, signed_half_sum),
    FIELD(FilmLightPasses, sum),
    FIELD(FilmLightPasses, low),
    FIELD(PixelError, luminance),
    FIELD(PixelError, noise),
    FIELD(PixelError, pooled_noise),
    FIELD(PixelError, bias),
    FIELD(PixelError, half_difference),
    FIELD(PrimaryHit, origin),
    FIELD(PrimaryHit, direction),
    FIELD(PrimaryHit, t),
    FIELD(PrimaryHit, u),
    FIELD(PrimaryHit, v),
    FIELD(PrimaryHit, primitive),
    FIELD(VisiblePoint, position),
    FIELD(VisiblePoint, normal),
    FIELD(VisiblePoint, weight),
    FIELD(VisiblePoint, radiance),
    FIELD(VisibleLightPasses, radiance),
    FIELD(VisibleSegment, offset),
    FIELD(VisibleLobe, wi),
    FIELD(VisibleLobe, normal),
    FIELD(VisibleLobe, color),
    FIELD(VisibleLobe, own),
    FIELD(VisibleLobe, kind),
    FIELD(Photon, position),
    FIELD(Photon, normal),
    FIELD(Photon, flux_rg),
    FIELD(Photon, flux_b),
    FIELD(PhotonBlock, position),
    FIELD(PhotonBlock, normal),
    FIELD(PhotonBlock, flux_rg),
    FIELD(PhotonBlock, flux_b),
    FIELD(Grid, origin),
    FIELD(Grid, nx),
    FIELD(Grid, ny),
    FIELD(Grid, nz),
    FIELD(Grid, first_bucket),
    FIELD(Wall, origin),
    FIELD(Wall, normal),
    FIELD(Wall, edge),
    FIELD(WallGrid, origin),
    FIELD(WallGrid, nx),
    FIELD(WallGrid, ny),
    FIELD(WallGrid, nz),
    FIELD(WallGrid, first_wall),
    FIELD(PhotonGrids, grid),
    FIELD(PhotonGrids, present),
    FIELD(PhotonGrids, separate),
    FIELD(PhotonGrids, photon_count),
    FIELD(Counters, photons),
    FIELD(Counters, indirect),
    FIELD(Counters, seeds),
    FIELD(Counters, rays),
    FIELD(Counters, non_finite),
    FIELD(Counters, saturated),
    FIELD(Counters, unresolved),
    FIELD(Counters, traversal_bound),
    FIELD(Counters, media_full),
    FIELD(Counters, media_left),
    FIELD(Counters, rays_high),
};

}  // namespace

TEST_CASE("shared structs have the same layout on the host and on the device") {
  std::string text =
      "#include \"shared/types.h\"\nkernel void offsets(global uint *out) {\n  if (get_global_id(0) != 0) "
      "return;\n";
  for (std::size_t i = 0; i < fields.size(); ++i)
    text += "  { global " + std::string(fields[i].type) + " *p = 0; out[" + std::to_string(i) +
            "] = (uint)(size_t)&p->" + fields[i].name + "; }\n";
  text += "}\n";
  auto program = build_test_program(text);
  auto out = test_device().buffer(fields.size() * sizeof(uint), "offsets");
  cl::Kernel kernel(program, "offsets");
  kernel.setArg(0, out);
  test_device().launch(kernel, 1);
  const auto offsets = test_device().download<uint>(out, fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    INFO(fields[i].type << "." << fields[i].name);
    CHECK(offsets[i] == fields[i].offset);
  }
}
