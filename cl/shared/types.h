// Every struct that the host and the kernels share, compiled by C++20 and by OpenCL C alike.
//
// Only scalars, float2/float4 and uint2/uint4 appear here, and `real` in what passes hand on: float3, bool, size_t,
// pointers and enums have sizes that differ between the two languages. CHECK_SIZE stops either compiler when a layout
// drifts, and a test compares the offset of every field as the device sees it with offsetof on the host.
#pragma once

#include "shared/materials.h"
#include "shared/real.h"
#include "shared/shapes.h"

#ifdef __OPENCL_VERSION__
typedef long int64;
#define CHECK_SIZE(type, size) typedef char type##_has_size_##size[(sizeof(type) == (size)) ? 1 : -1]
#else
#include <bit>
#include <cstdint>
namespace causticl {
using uint = std::uint32_t;
using ushort = std::uint16_t;
using ulong = std::uint64_t;
using int64 = std::int64_t;
struct alignas(8) float2 {
  float x = 0, y = 0;
};
struct alignas(16) float4 {
  float x = 0, y = 0, z = 0, w = 0;
};
struct alignas(8) uint2 {
  uint x = 0, y = 0;
};
struct alignas(16) uint4 {
  uint x = 0, y = 0, z = 0, w = 0;
};
#define CHECK_SIZE(type, size) static_assert(sizeof(type) == (size), #type " must have the device's layout")
#endif

// In this order: what a pass is told holds the camera. They are for types.h alone, which gives them their language.
#include "shared/scene_records.h"
#include "shared/pass_records.h"
#include "shared/exact_sum_records.h"
#include "shared/pixel_records.h"
#include "shared/photon_records.h"
#include "shared/wall_records.h"

#ifndef __OPENCL_VERSION__
}  // namespace causticl
#endif
