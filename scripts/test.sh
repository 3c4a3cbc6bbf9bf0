#!/usr/bin/env bash
# Usage: scripts/test.sh [--long] [--sanitize | --debug]
# Installs what is missing, builds, checks the format of the sources and runs the tests.
#   --long      also the tests that take minutes each
#   --sanitize  the host under AddressSanitizer, LeakSanitizer and UBSan, in build-sanitize/, without the tests that
#               run little but kernels, which no sanitizer sees
#   --debug     with all assertions, in build-debug/
set -euo pipefail
source "$(dirname "$0")/common.sh"

folder=build
options=(-DCAUSTICL_TESTS=ON)
# Warnings are errors where CAUSTICL_WERROR is set, as in CI. Elsewhere what scripts/render.sh has built stays as it is, and
# the tests alone are compiled.
type=()
[ -z "${CAUSTICL_WERROR:-}" ] || type=(-DCAUSTICL_WERROR=ON)
ctest_options=()
for argument in "$@"; do
  case $argument in
    --long) ctest_options+=(-C long) ;;
    --sanitize)
      folder=build-sanitize
      type=(-DCMAKE_BUILD_TYPE=Debug -DCAUSTICL_SANITIZE=ON)
      # Kernels are machine code that PoCL compiles without sanitizers, and the sanitizers make the compiler in PoCL
      # slow. What is left out here compares kernels with oracles (kernels/, stability/) or whole pictures with
      # references; the host code behind them runs in render/, scene/, cli/ and study/ too.
      ctest_options+=(-E '^(kernels/|stability/|render/test_(agreement|furnace|irradiance|references|lights|stress|precision)|effects/test_(compiled|explain))|/long$')
      # Drivers keep what they allocate until the process ends. Tests that use none look for leaks: see
      # tests/CMakeLists.txt.
      export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0}
      export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
      ;;
    --debug)
      folder=build-debug
      type=(-DCMAKE_BUILD_TYPE=Debug)
      ;;
    -h | --help)
      sed -n '2,7s/^# //p' "$0"
      exit
      ;;
    *) fail "unknown argument $argument; expected --long, --sanitize or --debug" ;;
  esac
done

set_up "${build_packages[@]}" "${test_packages[@]}"
build "$folder" all "${options[@]}" "${type[@]}"

# Versions of clang-format differ in taste: the sources follow Debian 12's.
formatted=true
if [[ $(clang-format --version 2>&1) == *"version 14."* ]]; then
  find "$root/host" "$root/tests" -name '*.[ch]pp' -print0 | xargs -0 clang-format --dry-run -Werror || formatted=false
else
  echo "The format is not checked: that needs clang-format 14." >&2
fi

# Side by side: most of the time of a test goes into compiling kernels, on one core each.
ctest --test-dir "$root/$folder" -j "$(nproc)" --output-on-failure --no-tests=error "${ctest_options[@]}" </dev/null
$formatted || fail "the tests passed, but the format differs (above); run clang-format -i on those files"
