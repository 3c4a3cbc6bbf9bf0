// Embree over the same triangles and rays; does nothing where it is not installed.
#pragma once

#include <memory>
#include <vector>

#include "accel/kdtree.hpp"
#include "bench/stopwatch.hpp"

namespace causticl {

/// A ray as the bench kernels take it: origin and t_max, direction.
struct BenchRay {
  float4 origin, direction;
};

class EmbreeReference {
 public:
  EmbreeReference(const std::vector<TreeTriangle>& triangles, unsigned threads);
  ~EmbreeReference();
  Elapsed build_time() const { return build_time_; }
  /// Distances (t_max for a miss) of the nearest hits, and the time taken.
  Elapsed closest(const std::vector<BenchRay>& rays, std::vector<float>& distances) const;
  /// 1 where something is met before t_max, and the time taken.
  Elapsed occluded(const std::vector<BenchRay>& rays, std::vector<uint>& result) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  unsigned threads_;
  Elapsed build_time_;
};

}  // namespace causticl
