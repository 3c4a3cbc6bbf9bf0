// The dielectrics of a scene as bodies: which of them touch, overlap or hold something, and which fills a
// place that several hold.
#pragma once

#include <string>
#include <vector>

#include "scene/object_bounds.hpp"

namespace causticl {

struct Dielectrics {
  /// What calls for paths to keep the media that they are in (EFFECT_NESTED); empty where every dielectric
  /// stands apart; then `bodies` is empty.
  std::string reason;

  /// The dielectric objects, as indices into Scene::objects. Where two hold a place the later one of this
  /// list fills it: that of the higher priority; where equal, the one that lies wholly inside the other; else
  /// the later object.
  std::vector<int> bodies;
  Vec3 inside_direction;  // of a ray that leaves a body more often than it enters it only from inside

  BoundingBox contact;  // where surfaces may touch
  bool holds_camera = false;
  std::vector<bool> holds_emitter;  // of each object: it emits, and a dielectric may hold or touch it
  std::vector<bool> holds_light;    // of each of Scene::lights
  bool touches_emitter = false;     // a dielectric touches one that emits

  /// For `info`: which dielectrics the camera and each emitter stand in, and which overlap without a
  /// priority.
  std::vector<std::string> lines;
};

/// A pure function of the scene.
Dielectrics find_dielectrics(const Scene& scene);

}  // namespace causticl
