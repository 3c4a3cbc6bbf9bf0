// The end of an SPPM pass: photons around each visible point, the pixel's statistics, the film.
#include "core/film_pixels.cl"
#include "photons/channel_shifts.cl"
#include "photons/kernel_area_mean.cl"
#include "photons/gather.cl"
#include "photons/visibility_grid.cl"
#include "photons/sppm.cl"
#include "photons/unknown_error.cl"
#include "photons/visible_point.cl"

// The photons around the segment of visible point `i` in the medium.
INLINE Gathered gather_visible_segment(Grid grid, global const uint *starts, global const PhotonBlock *sorted,
                                       global VisiblePoint *visible_points, uint i, const Params *params, real radius2) {
  real3 offset = vload3(0, visible_segments(visible_points, params)[i].offset);
  real length2 = dot(offset, offset), length = sqrt(length2);
  if (!(length2 > 0)) return gathered_none();
  MediumSegment segment = {vload3(0, visible_points[i].position), offset / length, 0, 0,
                           convert_real3(params->extinction.xyz), params->extinction.w};
  return gather_medium(grid, starts, sorted, segment, length, radius2);
}

// The square of the radius within which photons of a kind are gathered, over that of focused ones.
INLINE real kind_radius2(const Params *params, uint kind) {
  return kind == INDIRECT_PHOTONS ? (real)params->indirect_radius * params->indirect_radius : (real)1;
}

// photon_counts[i] = photons of a kind within its radius around visible point i, over the square of that radius, in units of
// params.radius2, and rounded; COUNT_NOTHING where the path met no diffuse surface. For choosing the first radius.
#define COUNT_NOTHING 0xffffffffu
kernel void count_around(global VisiblePoint *visible_points, global const uint *starts,
                         global const PhotonBlock *sorted, global uint *photon_counts, PhotonGrids grids,
                         Params params) {
  uint i = get_global_id(0);
  if (i >= params.pixel_count * params.visible_points) return;
  VisiblePoint point = visible_points[i];
  real3 position = vload3(0, point.position);
  real count = 0;
  bool nothing = !(point.weight[0] + point.weight[1] + point.weight[2] > 0);
  bool in_medium = HAS(EFFECT_MEDIUM) && (point.normal & IN_MEDIUM);
#pragma unroll
  for (uint kind = 0; kind < PHOTON_KINDS; ++kind) {
    if (nothing || !grids.present[kind] || (in_medium && kind != FOCUSED_PHOTONS)) continue;
    real wider = kind_radius2(&params, kind);
    if (in_medium)
      count = gather_visible_segment(grids.grid[kind], starts, sorted, visible_points, i, &params, params.radius2).count;
    else
      count += gather(grids.grid[kind], starts, sorted, position, point.normal, params.radius2 * wider).count /
               wider;
  }
  photon_counts[i] = nothing ? COUNT_NOTHING : (uint)(count + (real)0.5f);
}

// Adds to each layer what the photons of it bring by `weight`; beyond the first diffuse vertex all is indirect.
INLINE void light_passes_gathered(Radiance *radiance, const Gathered *sum, real3 weight, bool beyond) {
  real3 direct = weight * (real3)(sum->direct_red, sum->direct_green, sum->direct_blue);
  real3 caustic = weight * (real3)(sum->caustic_red, sum->caustic_green, sum->caustic_blue);
  real3 indirect = weight * (real3)(sum->red - sum->direct_red - sum->caustic_red,
                                    sum->green - sum->direct_green - sum->caustic_green,
                                    sum->blue - sum->direct_blue - sum->caustic_blue);
  radiance->layer[beyond ? LIGHT_PASS_INDIRECT : LIGHT_PASS_DIRECT] += direct;
  radiance->layer[beyond ? LIGHT_PASS_INDIRECT : LIGHT_PASS_CAUSTIC] += caustic;
  radiance->layer[LIGHT_PASS_INDIRECT] += indirect;
}

// One pixel: equation (7) of Hachisuka & Jensen 2009 for this pass, averaged over its visible points, goes to
// the film, with how much less half the radius around each point says; equations (8) and (9) update its radius. With
// params.radius2 > 0 that radius holds for all pixels.
kernel void gather_photons(global VisiblePoint *visible_points, global SppmPixel *pixels,
                           global FilmPixel *film, global const uint *starts, global const PhotonBlock *sorted,
                           volatile global Counters *counters, PhotonGrids grids, Params params,
                           global const WallGrid *wall_grid) {
  uint i = get_global_id(0);
  if (i >= params.pixel_count) return;
  uint index = params.first_pixel + i;
  SppmPixel pixel = pixels[index];
  for (uint s = 0; s < params.visible_points; ++s)
    pixel.coverage = kernel_area_add(pixel.coverage, visible_points[i * params.visible_points + s].normal, params.pass);
  real radius2 = params.radius2 > 0 ? (real)params.radius2 : (real)pixel.radius2_hi;
  real3 reflected = (real3)(0, 0, 0), reflected_near = (real3)(0, 0, 0);
  Radiance radiance = radiance_none();
  real3 density = channel_unit(params.channel_shifts) * ((real)params.photon_flux / (PHOTON_FLUX_UNIT * PI * radius2));
  real widest = sqrt(radius2) * fmax((real)params.indirect_radius, (real)1);
  uint found = 0;
  // The flux around a point is divided by the area that surfaces cover, in that of the own radius.
  real inverse_area[PHOTON_KINDS], near_inverse_area[PHOTON_KINDS];
#pragma unroll
  for (uint kind = 0; kind < PHOTON_KINDS; ++kind) {
    real wider = kind_radius2(&params, kind);
    float of_probes = kind == INDIRECT_PHOTONS ? 1 : 1 / params.indirect_radius;
    inverse_area[kind] = 1 / (wider * kernel_area_of(pixel.coverage, of_probes));
    near_inverse_area[kind] = 1 / (wider * kernel_area_of(pixel.coverage, of_probes / 2));
  }
  for (uint s = 0; s < params.visible_points; ++s) {
    VisiblePoint point = visible_points[i * params.visible_points + s];
    radiance.sum += vload3(0, point.radiance);
    if (HAS(OUTPUT_LIGHT_PASSES)) {
      global const VisibleLightPasses *layers = visible_layers(visible_points, &params);
      for (uint k = 0; k < LIGHT_PASS_COUNT; ++k)
        radiance.layer[k] += vload3(0, layers[i * params.visible_points + s].radiance[k]);
    }
    real3 weight = vload3(0, point.weight);
    if (!(max_component(weight) > 0)) continue;
    bool in_medium = HAS(EFFECT_MEDIUM) && (point.normal & IN_MEDIUM);
    NearWalls near;
    const NearWalls *walls = 0;
    if (HAS(EFFECT_WALLS) && !in_medium &&
        walls_near(wall_grid, vload3(0, point.position), convert_real3(normal_unpack(point.normal)), widest, &near))
      walls = &near;
#pragma unroll
    for (uint kind = 0; kind < PHOTON_KINDS; ++kind) {
      if (!grids.present[kind] || (in_medium && kind != FOCUSED_PHOTONS)) continue;
      Gathered sum;
      VisibleLobe lobe;
      bool weighed = false;
      if (HAS(EFFECTS_OF_MATERIALS(SCATTERS)) && !in_medium) {
        lobe = visible_lobes(visible_points, &params)[i * params.visible_points + s];
        weighed = scatters(lobe.kind);
      }
      real3 flux_weight, near_flux_weight;
      if (in_medium) {
        real g = params.extinction.w;
        sum = gather_visible_segment(grids.grid[kind], starts, sorted, visible_points, i * params.visible_points + s, &params,
                                     radius2);
        flux_weight = weight * (phase_density(g, g < 0 ? -1 : 1) / PHASE_UNIT);
        near_flux_weight = flux_weight;
      } else {
        sum = gather_beside(grids.grid[kind], starts, sorted, vload3(0, point.position), point.normal,
                            radius2 * kind_radius2(&params, kind), walls, weighed ? &lobe : 0);
        flux_weight = weight * inverse_area[kind];
        near_flux_weight = weight * near_inverse_area[kind];
        if (HAS(EFFECTS_OF_MATERIALS(SCATTERS)) && weighed) flux_weight /= LOBE_UNIT, near_flux_weight /= LOBE_UNIT;
      }
      reflected += flux_weight * (real3)(sum.red, sum.green, sum.blue);
      reflected_near += near_flux_weight * (real3)(sum.near_red, sum.near_green, sum.near_blue);
      found = add_sat(found, sum.count);
      if (HAS(OUTPUT_LIGHT_PASSES) && sum.count > 0)
        light_passes_gathered(&radiance, &sum, flux_weight * density, point.normal & BEYOND_DIFFUSE);
    }
  }
  real3 kernel_bias = (reflected - 4 * reflected_near) * (density / (real)params.visible_points);
  if (found > 0) radiance.sum += reflected * density;
  radiance.sum /= params.visible_points;
  if (HAS(OUTPUT_LIGHT_PASSES))
    for (uint k = 0; k < LIGHT_PASS_COUNT; ++k) radiance.layer[k] /= params.visible_points;
  film_add_radiance(film, index, film_pixels(&params), &radiance, luminance(kernel_bias.x, kernel_bias.y, kernel_bias.z),
                    params.pass, counters);
  if (found > 0 && !(film[index].missed < 0)) film[index].missed = -1;
  pixels[index] = params.radius2 > 0 ? sppm_count(pixel, found) : sppm_update(pixel, found, params.alpha);
}

// Marks the cells around visible points on surfaces: see mark_visible_cells.
kernel void mark_visible_points(global const VisiblePoint *visible_points, volatile global uint *visibility, Grid cells,
                                float reach, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  VisiblePoint point = visible_points[i];
  if (!(point.weight[0] + point.weight[1] + point.weight[2] > 0) || (point.normal & IN_MEDIUM)) return;
  mark_visible_cells(visibility, cells, normal_unpack(point.normal), vload3(0, point.position), reach);
}

// The same for the pilot, which asks which photons are of use: of surfaces that face the same way alone, so that photons on
// the other side of a ceiling are not, though points on walls below might gather some of them.
kernel void mark_in_view(global const VisiblePoint *visible_points, volatile global uint *visibility, Grid cells, float reach,
                         uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  VisiblePoint point = visible_points[i];
  if (!(point.weight[0] + point.weight[1] + point.weight[2] > 0) || (point.normal & IN_MEDIUM)) return;
  mark_visible_facing(visibility, cells, facing_bit(normal_unpack(point.normal)), vload3(0, point.position), reach);
}

// Adds to *marked the photons on surfaces that landed in cells of the visibility grid.
kernel void count_visible(global const Photon *photons, global const uint *visibility, volatile global uint *visible, Grid cells,
                         uint count) {
  uint i = get_global_id(0);
  if (i >= count || (photons[i].normal & IN_MEDIUM)) return;
  real3 position = vload3(0, photons[i].position);
  if (lies_in_grid(cells, position) && is_visible(visibility, cells, normal_unpack(photons[i].normal), position))
    atomic_inc(visible);
}

// Every pixel's first radius.
kernel void start_pixels(global SppmPixel *pixels, uint count, float radius2) {
  uint i = get_global_id(0);
  if (i >= count) return;
  SppmPixel pixel = {radius2, 0, 0, 0, 0};
  pixels[i] = pixel;
}
