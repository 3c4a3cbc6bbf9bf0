// What SPPM decides by looking: the first radius, and how photons start. A pilot traces the first photons of
// the scene and a coarse picture of the whole frame. It is a function of scene and seed alone, so that every
// device, process and resumed render decides the same.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "shared/types.h"

namespace causticl {

/// What the camera sees, and what lies around that.
struct Surroundings {
  bool sees_surface = false;  // that reflects, or a medium that scatters
  Vec3 low, high;             // box of the middle nine tenths of what is seen
  double room = 0;            // how wide the space around that is
};

/// Of points that the camera sees, and for each how far it is from there to what a random ray meets:
/// infinite where it meets nothing. The room is as wide as the median ray is long; where most rays meet
/// nothing, it is what the camera sees of it.
Surroundings surroundings_of(std::span<const Vec3> points, std::span<const float> distances);

/// No first radius is larger than this fraction of the room: within it photons of one wall pass for light of
/// another, and light bends around corners.
constexpr double largest_radius_fraction = 0.05;

/// The radius within which a search looks that begins at `start`: see Sppm::choose_first_radius.
struct Pilot {
  Surroundings around;
  double first_radius = 0;
  bool radius_at_limit = false;        // larger ones would find more photons, but are too large for the room
  bool photons_found = true;           // by any point of the coarse picture
  double useful = 1;                   // of the photons, that land where the camera sees
  std::vector<EmissionCell> emission;  // by which photons start; empty: everywhere
  double useful_by_map = 0;            // the same with the map
  bool copies = false;                 // of useful photons: see metropolis_photons.hpp
};

/// What was decided and why, a line each; for notes and for `explain`.
std::vector<std::string> pilot_lines(const Pilot& pilot, const RendererSpec& renderer);

}  // namespace causticl
