#!/usr/bin/env bash
# Usage: scripts/test.sh [--long] [--sanitize]
# Installs what is missing, builds, checks the format of the sources and runs the tests.
#   --long      also the tests that take minutes each
#   --sanitize  under AddressSanitizer and UndefinedBehaviorSanitizer, in build-sanitize/
set -euo pipefail
source "$(dirname "$0")/common.sh"

folder=build
options=(-DCAUSTICL_TESTS=ON -DCAUSTICL_WERROR=ON)
ctest_options=()
for argument in "$@"; do
  case $argument in
    --long) ctest_options+=(-C long) ;;
    --sanitize)
      folder=build-sanitize
      options+=(-DCAUSTICL_SANITIZE=ON)
      # Drivers keep what they allocate until the process ends.
      export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0}
      ;;
    -h | --help)
      sed -n '2,5s/^# //p' "$0"
      exit
      ;;
    *) fail "unknown argument $argument; expected --long or --sanitize" ;;
  esac
done

set_up "${build_packages[@]}" "${test_packages[@]}"
build "$folder" all "${options[@]}"

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
