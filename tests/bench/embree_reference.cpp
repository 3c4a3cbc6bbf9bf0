#include "bench/embree_reference.hpp"

#ifdef CAUSTICL_EMBREE
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#endif

#include <cstring>
#include <limits>

#include "base/task_pool.hpp"
#include "bench/bench_traversal.hpp"

namespace causticl {

#ifdef CAUSTICL_EMBREE

namespace {

RTCRay embree_ray(const BenchRay& ray) {
  RTCRay result{};
  result.org_x = ray.origin.x, result.org_y = ray.origin.y, result.org_z = ray.origin.z;
  result.dir_x = ray.direction.x, result.dir_y = ray.direction.y, result.dir_z = ray.direction.z;
  result.tfar = ray.origin.w;
  result.mask = ~0u;
  return result;
}

#if RTC_VERSION_MAJOR >= 4
void intersect(RTCScene scene, RTCRayHit& hit) { rtcIntersect1(scene, &hit, nullptr); }
void occlude(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray, nullptr); }
#else
void intersect(RTCScene scene, RTCRayHit& hit) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &hit);
}
void occlude(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}
#endif

}  // namespace

struct EmbreeReference::State {
  RTCDevice device;
  RTCScene scene;
};

bool bench_has_embree() { return true; }

EmbreeReference::EmbreeReference(const std::vector<TreeTriangle>& triangles, unsigned threads)
    : state_(std::make_unique<State>()), threads_(threads) {
  state_->device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  state_->scene = rtcNewScene(state_->device);
  RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                            triangles.size() * 3);
  std::memcpy(positions, triangles.data(), triangles.size() * sizeof(TreeTriangle));
  auto* indices = static_cast<uint*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
  for (std::size_t i = 0; i < triangles.size() * 3; ++i) indices[i] = static_cast<uint>(i);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(state_->scene, geometry);
  rtcReleaseGeometry(geometry);
  const Stopwatch watch;
  rtcCommitScene(state_->scene);
  build_time_ = watch.elapsed();
}

EmbreeReference::~EmbreeReference() {
  rtcReleaseScene(state_->scene);
  rtcReleaseDevice(state_->device);
}

Elapsed EmbreeReference::closest(const std::vector<BenchRay>& rays, std::vector<float>& distances) const {
  distances.resize(rays.size());
  const Stopwatch watch;
  parallel_chunks(rays.size(), 16384, threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      RTCRayHit hit;
      hit.ray = embree_ray(rays[i]);
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      intersect(state_->scene, hit);
      distances[i] = hit.ray.tfar;
    }
  });
  return watch.elapsed();
}

Elapsed EmbreeReference::occluded(const std::vector<BenchRay>& rays, std::vector<uint>& result) const {
  result.resize(rays.size());
  const Stopwatch watch;
  parallel_chunks(rays.size(), 16384, threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      RTCRay ray = embree_ray(rays[i]);
      occlude(state_->scene, ray);
      result[i] = ray.tfar < 0;
    }
  });
  return watch.elapsed();
}

#else

struct EmbreeReference::State {};
bool bench_has_embree() { return false; }
EmbreeReference::EmbreeReference(const std::vector<TreeTriangle>&, unsigned threads) : threads_(threads) {}
EmbreeReference::~EmbreeReference() = default;
Elapsed EmbreeReference::closest(const std::vector<BenchRay>&, std::vector<float>&) const { return {}; }
Elapsed EmbreeReference::occluded(const std::vector<BenchRay>&, std::vector<uint>&) const { return {}; }

#endif

}  // namespace causticl
