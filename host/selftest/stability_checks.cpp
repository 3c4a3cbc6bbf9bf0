#include "selftest/stability_checks.hpp"

#include <algorithm>
#include <map>

namespace causticl {

std::vector<Check> stability_checks() {
  std::vector<Check> all;
  for (const auto& group : {sphere_checks(),
                            triangle_checks(),
                            sliver_checks(),
                            slab_checks(),
                            flat_box_checks(),
                            kdtree_checks(),
                            spawned_ray_checks(),
                            placement_checks(),
                            bezier_checks(),
                            sampling_checks(),
                            light_sampling_checks(),
                            light_point_checks(),
                            delta_light_checks(),
                            environment_checks(),
                            media_checks(),
                            fresnel_checks(),
                            rough_lobe_checks(),
                            rough_lobe_sampling_checks(),
                            energy_checks(),
                            sum_checks(),
                            progressive_radius_checks(),
                            photon_grid_checks(),
                            execution_order_checks(),
                            random_number_checks(),
                            path_number_checks(),
                            non_finite_checks(),
                            arithmetic_checks(),
                            bent_normal_checks(),
                            nested_checks(),
                            wall_checks()})
    for (Check check : group) {
      // A file's checks share its kernels, unless they say otherwise.
      if (check.programs.empty()) check.programs = group.front().name;
      all.push_back(check);
    }
  std::map<int, double>
      inputs_for_one;  // of a case: what all its checks try while a check of cost 1 tries one
  for (const auto& check : all) inputs_for_one[check.hard_case] += 1.0 / check.input_cost;
  for (auto& check : all) check.input_fraction = 1 / (check.input_cost * inputs_for_one[check.hard_case]);
  std::stable_sort(all.begin(), all.end(),
                   [](const Check& a, const Check& b) { return a.hard_case < b.hard_case; });
  return all;
}

}  // namespace causticl
