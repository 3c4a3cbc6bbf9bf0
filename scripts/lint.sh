#!/usr/bin/env bash
# Usage: scripts/lint.sh [--seconds N]
# Installs what is missing, builds, and runs clang-tidy with the checks of .clang-tidy over host/, newest commits first.
#   --seconds N  begins no file after N seconds
set -euo pipefail
source "$(dirname "$0")/common.sh"

seconds=
while [ $# -gt 0 ]; do
  case $1 in
    --seconds)
      [[ ${2:-} =~ ^[0-9]+$ ]] || fail "--seconds wants a number"
      seconds=$2
      shift
      ;;
    -h | --help)
      sed -n '2,4s/^# //p' "$0"
      exit
      ;;
    *) fail "unknown argument $1; expected --seconds N" ;;
  esac
  shift
done

set_up "${build_packages[@]}" "${lint_packages[@]}"
build build causticl_host

# By the last commit of each; what is in no commit yet comes first, and all of it where there is no history.
cd "$root"
files=$({
  git ls-files --modified --others --exclude-standard -- 'host/*.cpp'
  git log --format= --name-only -- 'host/*.cpp'
  find host -name '*.cpp' | sort
} 2>/dev/null | awk '!seen[$0]++' | while read -r file; do [ ! -f "$file" ] || echo "$file"; done)

deadline=$((${seconds:-1000000000} + $(date +%s)))
export deadline
checked=$(mktemp)
trap 'rm -f "$checked"' EXIT
export checked
status=0
# Warnings of system headers are counted on stderr, file by file.
xargs -n 1 -P "$(nproc)" bash -c '
  [ "$(date +%s)" -lt "$deadline" ] || exit 0
  echo >>"$checked"
  clang-tidy --quiet -p build "$1" 2>/dev/null' _ <<<"$files" || status=1
echo "clang-tidy: $(wc -l <"$checked") of $(wc -l <<<"$files") files of host/" >&2
[ $status -eq 0 ] || fail "clang-tidy has findings (above)"
