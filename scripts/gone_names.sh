#!/usr/bin/env bash
# Usage: scripts/gone_names.sh [CAUSTICL]
# Finds names that the tree has given up for the field's own (docs/glossary.md) in host/, cl/, tests/, scripts/, the
# documents and what --help of the program CAUSTICL (build/causticl) prints. Prints each place and fails where there is
# any. CHANGELOG.md and docs/performance-log.md may name them.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)

# Whole identifiers and phrases, several a line.
names=(
  AIM_CELLS AIM_SIDE AIM_SQUARES AimCell BEYOND_RECEIVER BIAS_OF_BLUR Blur COVERAGE_COUNT_MASK
  COVERAGE_FIRST_PROBES COVERAGE_LEAST COVERAGE_MOST_HITS COVERAGE_OF_HALF COVERAGE_PROBED COVERAGE_PROBES
  COVERAGE_RARELY COVERAGE_SHARE_OF_HALF COVERAGE_SHIFT DIM_COVERAGE DIM_LOOK EFFECT_NEEDLES EVENT_LANDED
  ErrorWatch FAULT_MEDIA_FULL FAULT_MEDIA_LEFT FAULT_TRAVERSAL_BOUND FAULT_UNRESOLVED FIRST_HITS_FOUND FaultKind
  Faults FilmLayers FirstHit FirstHits HALVES_REACH HISTORY_NO_RECEIVER HISTORY_SCATTERED HISTORY_SPECULAR
  HISTORY_STRAIGHT HORIZON_SHARE KDTREE_WAVES Knob KnobContext KnobValue LAYER_CAUSTIC LAYER_COUNT LAYER_DIRECT
  LAYER_INDIRECT LOOKING_VERTICES LOOPED_EMISSION LOOPED_EVENTS LOOPED_RECEIVERS NEEDLE_SINE2 NEIGHBOURS_SHARE
  NOISE_OF_BLUR OUTPUT_LAYERS PHOTONS_COPIES PHOTONS_SCOUTS PHOTONS_SEEDS PHOTONS_TO_AIM_BY PHOTON_LAYER_SHIFT
  PhotonAim PhotonGuide RECEIVERS_SIDE_BY_SIDE ROULETTE_DEPTH Receivers SeedStatistics ShareTable UNKNOWN_SHARE
  UnshadowedLight VisibleLayers WAVE_BRUTE_FORCE WAVE_CAPACITY WAVE_REFILL WAVE_SIDE_BY_SIDE WAVE_STEP Wave
  WaveHits WaveWalk WorldBuilder add_lamp added_blur aim_cell aim_cells aim_landed aim_square aimed_share along3
  arriving_cosine befalls block_meets blur_around build_world check_waves closest_in_wave count_faults
  coverage_add coverage_closest coverage_goes_on coverage_mean coverage_of coverage_probe coverage_wanted
  difference3 distant_origin emission_share even_and_apart fault_kinds fault_warnings file_fingerprint
  fingerprint_now fingerprint_of first_hit first_hit_buffer_ first_hit_bytes_ first_hits_ first_hits_of
  geometry_surface_parts guided_share has_needles history_after history_layer is_knob is_marked kdtree_wave
  kernels_fingerprint lamps_of landed_ landed_here largest_radius_share layers_gathered least_scouts least_share
  leaving_g leaving_s left_share look_along_lobe look_aside make_shares mark_bytes mark_cells mark_facing
  marked_across marked_share marks_ meet_all meet_one meet_others meets_box most_copies most_scouts
  near_share_of_kind needle_checks needle_normal needles_reason of_seeds packet_meets packet_meets_box
  packet_walk path_random4_parts photon_copies photon_event photon_layer place_scene product3 reach_share
  receiver_asks receiver_count receiver_light receiver_mark receiver_point receiver_ray receiver_reflects
  receiver_sampler receivers receivers_find_light receivers_find_points receivers_finish receivers_probe
  receivers_put receivers_repeat receivers_shadow receivers_store red_share runs_items_in_turn scene_fingerprint
  scout scout_share scouts_ seeds_found_ segment_share set_share share_ share_below share_buffer share_dither
  share_near share_numbers share_of_different share_of_kind share_of_variance share_out share_within shares_
  shares_text side_by_side single_faults study_knobs sum3 surface_put_together surface_take_apart table_of_knobs
  take_aim trace_share unshadowed_light upload_scene useful_scouts varnish walk_axis walk_back walk_begin
  walk_block walk_child walk_node walk_shapes walk_slab walk_to walk_triangle walk_triangles wanted_knobs
  wave_closest wave_compact wave_contacts wave_emit wave_faults wave_get wave_guide wave_learn wave_move
  wave_padded wave_paths wave_put wave_put_record wave_ray wave_scatter wave_store wave_stream wave_trace
  'guided photons' 'aimed photons' 'even numbers' 'marked cells' 'numbers of camera paths'
)

documents=("$root/README.md" "$root/CONTRIBUTING.md")
for page in "$root"/docs/*.md; do
  [ "$(basename "$page")" = performance-log.md ] || documents+=("$page")
done
pattern=$(printf '%s\n' "${names[@]}")
found=0
# Takes the exit code of a search: 0 where something was found, 1 where nothing was, and else an error.
note() {
  [ "$1" -le 1 ] || { echo "error: a search failed" >&2; exit 2; }
  [ "$1" -eq 1 ] || found=1
}
code=0
grep -rnwFI -f <(printf '%s\n' "$pattern") --include='*.cpp' --include='*.hpp' --include='*.cl' --include='*.h' --include='*.patch' \
  --include='*.py' --include='*.sh' --exclude=gone_names.sh "$root/host" "$root/cl" "$root/tests" "$root/scripts" || code=$?
note $code
code=0
grep -nwFI -f <(printf '%s\n' "$pattern") "${documents[@]}" || code=$?
note $code
causticl=${1:-$root/build/causticl}
help=$(mktemp)
trap 'rm -f "$help"' EXIT
if [ -x "$causticl" ]; then
  for command in '' render compare devices explain info schema study selftest; do
    "$causticl" ${command:+"$command"} --help >"$help"
    code=0
    grep -nwF -f <(printf '%s\n' "$pattern") "$help" || code=$?
    note $code
  done
fi
exit $found
