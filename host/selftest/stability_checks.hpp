// The checks of the hard cases, one source file a group.
#pragma once

#include "selftest/selftest_check.hpp"

namespace causticl {

/// Check::programs of those that render whole pictures.
inline const std::string pass_programs = "passes";

/// All checks, by number of their hard case.
std::vector<Check> stability_checks();

std::vector<Check> sphere_checks();               // hard cases 1 and 2
std::vector<Check> triangle_checks();             // hard cases 3 and 4
std::vector<Check> sliver_checks();               // hard case 5
std::vector<Check> slab_checks();                 // hard case 6: the slab test
std::vector<Check> flat_box_checks();             // hard case 6: through the tree
std::vector<Check> kdtree_checks();               // hard case 7
std::vector<Check> spawned_ray_checks();          // hard case 8
std::vector<Check> placement_checks();            // hard case 9
std::vector<Check> bezier_checks();               // hard case 10
std::vector<Check> sampling_checks();             // hard cases 11 and 23
std::vector<Check> light_sampling_checks();       // hard case 23: the choice of a light
std::vector<Check> light_point_checks();          // hard case 23: points on lights
std::vector<Check> delta_light_checks();          // hard case 23: light without surface
std::vector<Check> environment_checks();          // hard case 23: light from beyond the scene
std::vector<Check> media_checks();                // hard cases 12 and 23: glass and medium along a path
std::vector<Check> fresnel_checks();              // hard case 12
std::vector<Check> rough_lobe_checks();           // hard case 13
std::vector<Check> rough_lobe_sampling_checks();  // hard case 13: samples against their density
std::vector<Check> energy_checks();               // hard cases 14 and 15
std::vector<Check> sum_checks();                  // hard case 16
std::vector<Check> progressive_radius_checks();   // hard cases 17 and 18
std::vector<Check> photon_grid_checks();          // hard case 19
std::vector<Check> execution_order_checks();      // hard case 20
std::vector<Check> random_number_checks();        // hard case 21
std::vector<Check> path_number_checks();          // hard case 21: sample dimensions of camera paths
std::vector<Check> non_finite_checks();           // hard case 22
std::vector<Check> arithmetic_checks();           // hard case 24
std::vector<Check> bent_normal_checks();          // hard case 25
std::vector<Check> nested_checks();               // hard case 26
std::vector<Check> wall_checks();                 // hard case 27

}  // namespace causticl
