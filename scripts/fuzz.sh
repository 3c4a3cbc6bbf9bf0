#!/usr/bin/env bash
# Usage: scripts/fuzz.sh [--seconds N] [--runs N] [TARGET...]
# Installs what is missing, builds the fuzzers with clang, AddressSanitizer and UBSan in build-fuzz/ and runs them
# one after the other on one core: all, or those that are named (scene override obj ply png jpeg hdr bmp tga pfm
# exr kernels study film). Inputs with new coverage are kept in build-fuzz/corpus/, and the next call goes on from
# there. Inputs that broke something are kept in build-fuzz/findings/.
#   --seconds N  for each target (60)
#   --runs N     at most so many executions of each target in this call
set -euo pipefail
source "$(dirname "$0")/common.sh"

seconds=60
runs=-1
chosen=()
while [ $# -gt 0 ]; do
  case $1 in
    --seconds | --runs)
      [[ ${2:-} =~ ^[0-9]+$ ]] || fail "$1 wants a number"
      if [ "$1" = --seconds ]; then seconds=$2; else runs=$2; fi
      shift
      ;;
    -h | --help)
      sed -n '2,9s/^# //p' "$0"
      exit
      ;;
    -*) fail "unknown argument $1; expected --seconds, --runs or the name of a target" ;;
    *) chosen+=("$1") ;;
  esac
  shift
done

corpus=$root/tests/fuzz/corpus
all=()
for target in "$corpus"/*; do all+=("$(basename "$target")"); done
for target in "${chosen[@]}"; do
  [ -d "$corpus/$target" ] || fail "no fuzz target $target; expected one of: ${all[*]}"
done
[ ${#chosen[@]} -gt 0 ] || chosen=("${all[@]}")

set_up "${build_packages[@]}" "${fuzz_packages[@]}"
# Assertions, and some optimisation: twice the executions a second and more.
build build-fuzz fuzzers -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g" -DCMAKE_CXX_COMPILER=clang++ \
  -DCAUSTICL_FUZZ=ON

work=$root/build-fuzz
mkdir -p "$work/findings" "$work/logs"
# Inputs pass through files: in memory, where there is room for that.
memory=/dev/shm
[ -w "$memory" ] || memory=${TMPDIR:-/tmp}
TMPDIR=$(mktemp -d "$memory/causticl-fuzz-XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

# Limits for one input: 10 seconds, 1 GiB at once and 2 GiB in all. They hold for inputs of at most 64 KiB.
limits=(-timeout=10 -malloc_limit_mb=1024 -rss_limit_mb=2048 -max_len=65536)
export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=detect_stack_use_after_return=0

# Executions of all calls, "TARGET NUMBER" a line.
total_of() {
  awk -v target="$1" '$1 == target { sum += $2 } END { print sum + 0 }' "$work/executions" 2>/dev/null || echo 0
}

table=()
found=0
for target in "${chosen[@]}"; do
  echo "fuzzing $target" >&2
  mkdir -p "$work/corpus/$target"
  log=$work/logs/$target.log
  failed=0
  "$work/tests/fuzz/fuzz_$target" "${limits[@]}" -max_total_time="$seconds" -runs="$runs" -print_final_stats=1 \
    -dict="$root/tests/fuzz/dictionaries/$target.dict" -artifact_prefix="$work/findings/$target-" \
    "$work/corpus/$target" "$corpus/$target" </dev/null >/dev/null 2>"$log" || failed=1
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "$target ${executions:-0}" >>"$work/executions"
  before=$(sed -n '/INITED/s/.* cov: \([0-9]*\).*/\1/p' "$log" | head -1)
  after=$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$log" | tail -1)
  table+=("$(printf '%-9s %12s %12s %10s %10s %9s' "$target" "${executions:-0}" "$(total_of "$target")" \
    "${before:-?}" "${after:-?}" "$failed")")
  if [ $failed -ne 0 ]; then
    found=$((found + 1))
    grep -E 'ERROR:|SUMMARY:|runtime error|terminate|what\(\)|Test unit written' "$log" | head -8 >&2 || true
  fi
done

printf '%-9s %12s %12s %10s %10s %9s\n' target executions "all calls" "cov begin" "cov end" findings
printf '%s\n' "${table[@]}"
echo "executions of all targets and calls: $(awk '{ sum += $2 } END { print sum + 0 }' "$work/executions")"
[ $found -eq 0 ] || fail "$found targets have findings: see build-fuzz/findings and build-fuzz/logs"
