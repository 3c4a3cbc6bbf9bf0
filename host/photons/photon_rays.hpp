// How photons find what they meet next, and shadow rays of camera paths what is in their way where
// those end in a batch (cl/photons/first_diffuse_vertices.cl).
#pragma once

#include <string>

#include "opencl/kernels.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// Through the tree, where the items of a work-group run in turn, in batches (cl/traversal/kdtree_stream.cl),
/// or sixteen at a time by brute force (cl/traversal/brute_force.cl); the picture is the same. `automatic`:
/// by brute force on CPUs where primitives are few.
enum class PhotonRays { automatic, tree, brute_force };

/// Whether the programs of a device are to trace photons and shadow rays by brute force. Never in double
/// precision, by the precomputed test, among revolved curves, and where bounded primitives are more than
/// BRUTE_FORCE_PRIMITIVES.
bool brute_force_chosen(PhotonRays wanted, const Scene& scene, const Device& device,
                        const KernelOptions& options);

/// What --stats says of photons: "sixteen at a time, each meets every primitive", "in a batch through the
/// tree", "one at a time".
std::string photon_rays_text(const KernelOptions& options, const Device& device);

}  // namespace causticl
