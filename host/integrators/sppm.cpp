#include "integrators/sppm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "base/spelling.hpp"
#include "device_scene/params.hpp"
#include "device_scene/walls.hpp"
#include "effects/effects.hpp"
#include "scene/lit_sides.hpp"
#include "scene/material_kind.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

// The primary hits of camera paths lie where their visible points will.
static_assert(sizeof(PrimaryHit) == sizeof(VisiblePoint));

/// Of the scene's half extent: the length of the pieces of camera rays in the medium around which photons are
/// gathered. Longer ones find more photons, in a time that grows with them: of 0.05, 0.3 and 1 this one has
/// the smallest error at equal time in scenes/effects/fog.json.
constexpr double segment_fraction = 0.3;

}  // namespace

Sppm::Sppm(const IntegratorInputs& in)
    : scene_(in.scene),
      spec_(in.scene.renderer),
      device_(in.device),
      film_(in.film),
      device_scene_(in.device_scene),
      programs_(in.programs),
      motion_(in.scene, in.device, in.device_scene, in.seed),
      params_(scene_params(in.scene, in.device_scene, in.seed)),
      counters_(in.device.buffer(sizeof(Counters), "counters")),
      guide_(in.device_scene, in.device, in.programs, static_cast<std::uint32_t>(spec_.photons),
             spec_.guided_photons.value_or(false) && in.with_photons),
      aim_(in.device,
           (in.programs.options().effects & EFFECT_AIMED_PHOTONS) ? in.device_scene.emitter_count : 0,
           static_cast<std::uint32_t>(spec_.photons),
           in.with_photons && (effect_bits(find_effects(in.scene)) & EFFECT_AIMED_PHOTONS)),
      photon_map_(in.device_scene, in.device, in.programs, counters_, guide_, aim_),
      with_photons_(in.with_photons && params_.emitter_count > 0),
      walled_(with_photons_ && (effect_bits(find_effects(in.scene)) & EFFECT_WALLS)),
      visible_point_bytes_(
          (sizeof(VisiblePoint) + (in.film.has_layers() ? sizeof(VisibleLightPasses) : 0) +
           ((in.programs.options().effects & EFFECT_MEDIUM) ? sizeof(VisibleSegment) : 0) +
           ((in.programs.options().effects & effects_of_kinds(SCATTERS)) ? sizeof(VisibleLobe) : 0)) *
          record_scale(in.programs.options().precision)),
      unknown_(in.device, in.programs) {
  device_.clear(counters_, sizeof(Counters));
  params_.visible_points = static_cast<uint>(spec_.visible_points);
  params_.shadow_rays = spec_.direct_light == DirectLight::shadow_rays && params_.emitter_count > 0;
  params_.coverage = spec_.boundary_correction && with_photons_;
  params_.alpha = static_cast<float>(spec_.alpha);
  film_.set_pixels(params_);
  params_.indirect_radius = static_cast<float>(indirect_radius(spec_));

  chunk_pixels_ = std::clamp<std::size_t>(launch_chunk(device_) / params_.visible_points, 1, film_.pixels());
  pixels_ = device_.buffer(film_.pixels() * sizeof(SppmPixel), "pixel statistics");

  // The first pass begins here, while programs that it needs later are still being built.
  if (with_photons_) photon_map_.prepare(programs_);
  began_ = Clock::now();
  start_pass(0);
  early_seconds_ = std::chrono::duration<double>(Clock::now() - began_).count();
  trace_camera_ = programs_.kernel("camera", "trace_camera");
  gather_photons_ = programs_.kernel("gather", "gather_photons");
  primary_hits_ = PrimaryHits(programs_, "camera", device_scene_, counters_);
  first_argument_ = set_scene_arguments(trace_camera_, device_scene_);
  trace_camera_.setArg(first_argument_ + 1, counters_);
  trace_camera_.setArg(first_argument_ + 3, pixels_);

  walls_ = device_.upload(no_walls(), "walls");
  trace_camera_.setArg(first_argument_ + 4, walls_);
  if (in.pilot)
    adopt(*in.pilot);
  else
    pilot_ = run_pilot();
  smallest_radius2_ = 1e-12 * length_scale(device_scene_) * length_scale(device_scene_);
  guide_.set_radius(pilot_.first_radius);
  unknown_.set_view(pilot_.around);
  totals_.start_from(device_.download<Counters>(counters_, 1)[0]);  // the passes alone are reported
  schedule_radius2_ = pilot_.first_radius * pilot_.first_radius;
  cl::Kernel start_pixels = programs_.kernel("gather", "start_pixels");
  set_arguments(start_pixels, pixels_, static_cast<cl_uint>(film_.pixels()),
                static_cast<float>(schedule_radius2_));
  device_.launch_pass(start_pixels, film_.pixels());
}

/// Places what moves for the pass and traces its photons, unless that has been done; before the first also
/// the pilot paths by which photons are aimed.
void Sppm::start_pass(std::uint32_t pass) {
  if (started_pass_ == pass) return;
  begin_pass(params_, pass);
  motion_.begin_pass(pass);
  set_emission(params_, device_scene_);
  if (pass == 0 && aim_.pilot_paths() > 0) {
    photon_map_.learn_projection_map(params_);
    totals_.start_from(device_.download<Counters>(counters_, 1)[0]);  // pilot paths are no part of the pass
  }
  trace_photons(pass);
  started_pass_ = pass;
}

void Sppm::trace_photons(std::uint32_t pass) {
  const auto emission = guide_.emission(pass);
  params_.photon_role = emission.role;
  params_.first_photon = static_cast<uint>(fraction_.first_of(emission.photons));
  params_.photon_count = static_cast<uint>(fraction_.count_of(emission.photons));
  params_.photon_flux = static_cast<float>(std::numbers::pi * device_scene_.emitted_power / emission.photons);
  if (with_photons_) totals_.update(photon_map_.trace(params_));
}

/// Where those of a chunk lie: in the memory of the photons as traced, once these have been sorted, if it is
/// large enough.
const cl::Buffer& Sppm::visible_points() {
  const std::size_t bytes = chunk_pixels_ * params_.visible_points * visible_point_bytes_;
  if (photon_map_.traced_bytes() >= bytes) {
    own_visible_points_ = {};
    return photon_map_.traced();
  }
  if (!own_visible_points_()) own_visible_points_ = device_.buffer(bytes, "visible points");
  return own_visible_points_;
}

/// Segments may have any length: those of a small radius are cut shorter, so that they cross few cubes.
float Sppm::segment(double radius) const {
  return static_cast<float>(
      std::min(segment_fraction * length_scale(device_scene_), MOST_SEGMENT_STEPS * 4 * radius));
}

/// Those of the chunk that `params` tells.
void Sppm::trace_visible_points(const cl::Buffer& points, const Params& params) {
  primary_hits_.launch(device_, device_scene_, points, params, params.visible_points);
  trace_camera_.setArg(first_argument_, points);
  trace_camera_.setArg(first_argument_ + 2, params);
  device_.launch_pass(trace_camera_, static_cast<std::size_t>(params.pixel_count) * params.visible_points);
}

/// Lists the walls for balls of the first radius, since no later radius is larger. Where something moves,
/// each pass lists them anew.
void Sppm::place_walls(std::uint32_t pass) {
  if (!walled_ || (walls_placed_ && !has_motion(scene_))) return;
  if (!walls_placed_) lit_sides_ = lit_sides(scene_);
  walls_placed_ = true;
  const double time =
      has_motion(scene_) ? pass_time(scene_.camera, params_.seed, pass) : scene_.camera.shutter[0];
  const double widest = pilot_.first_radius * std::max(1.0, indirect_radius(spec_));
  walls_ = device_.upload(wall_grid(scene_, flatten_scene(scene_, time), lit_sides_, time, widest), "walls");
  trace_camera_.setArg(first_argument_ + 4, walls_);
}

/// Equation (9) with a pixel's photons as they are on average, or Knaus & Zwicker 2011, equation 14:
/// R'^2 = R^2 (i + alpha) / (i + 1) for i = 1, 2, ...
void Sppm::advance_schedule(std::uint32_t pass) {
  if (spec_.schedule == Schedule::geometric)
    schedule_radius2_ *= spec_.radius_decay * spec_.radius_decay;
  else
    schedule_radius2_ *= (pass + 1 + spec_.alpha) / (pass + 2.0);
  // A radius that vanishes beside the scene finds nothing, and its square would underflow.
  schedule_radius2_ = std::max(schedule_radius2_, smallest_radius2_);
}

void Sppm::enqueue_pass(std::uint32_t pass) {
  start_pass(pass);
  set_scene_arguments(trace_camera_, device_scene_);
  place_walls(pass);
  // A pixel with radii of its own starts from the same one: the schedule then tells the usual size of a cell.
  params_.radius2 = spec_.schedule == Schedule::pixel ? 0.0f : static_cast<float>(schedule_radius2_);
  emitted_ += with_photons_ ? static_cast<std::uint64_t>(spec_.photons) : 0;
  const double radius = std::sqrt(schedule_radius2_);
  photon_map_.sort(radius, radius * indirect_radius(spec_));
  params_.segment = segment(radius);
  if (photon_map_.stored() > 0) film_.set_photons_stored();
  const bool look_for_unknown = with_photons_ && unknown_.due(pass);
  if (look_for_unknown) unknown_.begin(photon_map_.records_buffer(), photon_map_.stored());

  const cl::Buffer& points = visible_points();
  const std::size_t end = fraction_.end_of(film_.pixels());
  for (std::size_t first = fraction_.first_of(film_.pixels()); first < end; first += chunk_pixels_) {
    params_.first_pixel = static_cast<uint>(first);
    params_.pixel_count = static_cast<uint>(std::min(chunk_pixels_, end - first));
    trace_visible_points(points, params_);
    set_arguments(gather_photons_, points, pixels_, film_.buffer(), photon_map_.starts(),
                  photon_map_.sorted(), counters_, photon_map_.grids(), params_, walls_);
    device_.launch_pass(gather_photons_, params_.pixel_count);
    guide_.mark(points, std::size_t{params_.pixel_count} * params_.visible_points, pass);
    if (look_for_unknown) unknown_.find(points, film_.buffer(), params_);
  }
  advance_schedule(pass);
}

PassIntegrator::Totals Sppm::finish() {
  totals_.update(device_.download<Counters>(counters_, 1)[0]);
  Diagnostics diagnostics = totals_.diagnostics;
  diagnostics.dropped = photon_map_.dropped();
  return {emitted_, photon_map_.stored(), totals_.rays, diagnostics, guide_.seeds()};
}

std::vector<Channel> Sppm::channels() {
  // One radius for all is that of the pass to come; photons are counted for radii of their own alone.
  const bool own_radii = spec_.schedule == Schedule::pixel;
  const auto pixels = film_.cropped(device_.download<SppmPixel>(pixels_, film_.pixels()));
  std::vector<Channel> channels{{"sppm.radius", std::vector<float>(pixels.size())}};
  for (std::size_t i = 0; i < pixels.size(); ++i)
    channels[0].values[i] =
        static_cast<float>(std::sqrt(own_radii ? pixels[i].radius2_hi : schedule_radius2_));
  if (!own_radii) return channels;
  channels.push_back({"sppm.photons", std::vector<float>(pixels.size())});
  channels.push_back({"sppm.N", std::vector<float>(pixels.size())});
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double photons = std::ldexp(pixels[i].photons_high, 32) + pixels[i].photons_low;
    channels[1].values[i] = static_cast<float>(photons);
    channels[2].values[i] = static_cast<float>(spec_.alpha * photons);
  }
  return channels;
}

double Sppm::bytes_per_pixel() const {
  const double chunk = static_cast<double>(chunk_pixels_ * params_.visible_points * visible_point_bytes_);
  return sizeof(SppmPixel) + (own_visible_points_() ? chunk / static_cast<double>(film_.pixels()) : 0);
}

std::unique_ptr<PassIntegrator> make_sppm(const IntegratorInputs& in) { return std::make_unique<Sppm>(in); }

ErrorRates rates_of_sppm(const RendererSpec& renderer) { return sppm_rates(renderer.alpha); }

std::string text_of_sppm(const RendererSpec& r) {
  std::ostringstream text;
  text << r.passes << (r.passes == 1 ? " pass of " : " passes of ") << r.photons << " photons, "
       << counted(static_cast<std::size_t>(r.visible_points), "visible point") << " a pixel, first radius ";
  if (r.radius)
    text << *r.radius;
  else
    text << "chosen from the scene";
  if (indirect_radius(r) != 1) text << " (" << indirect_radius(r) << " times that for indirect light)";
  if (r.schedule == Schedule::geometric)
    text << ", geometric schedule with radius decay " << r.radius_decay;
  else
    text << ", " << (r.schedule == Schedule::pixel ? "pixel" : "global") << " schedule with alpha "
         << r.alpha;
  if (!r.boundary_correction) text << ", no boundary correction";
  if (r.guided_photons) text << (*r.guided_photons ? ", Metropolis photons" : ", without Metropolis photons");
  if (r.aimed_photons)
    text << (*r.aimed_photons ? ", photons by the projection map" : ", photons without a projection map");
  text << ", direct light by " << (r.direct_light == DirectLight::photons ? "photons" : "shadow rays");
  return text.str();
}

}  // namespace causticl
