#!/usr/bin/env bash
# Usage: scripts/kill_test.sh [--renders N] [--studies N]
# Kills N renders with three outputs each (200) and N studies (100) with SIGKILL, each after another share of the
# time that it takes. A killed run must leave no damaged file, the next run must work, and what the killed ones left
# behind must be gone after it. Takes minutes: it is no part of scripts/test.sh.
set -euo pipefail
source "$(dirname "$0")/common.sh"

renders=200
studies=100
while [ $# -gt 0 ]; do
  case $1 in
    --renders | --studies)
      [[ ${2:-} =~ ^[0-9]+$ ]] || fail "$1 wants a number"
      if [ "$1" = --renders ]; then renders=$2; else studies=$2; fi
      shift
      ;;
    -h | --help)
      sed -n '2,5s/^# //p' "$0"
      exit
      ;;
    *) fail "unknown argument $1; expected --renders or --studies" ;;
  esac
  shift
done

set_up "${build_packages[@]}"
build build causticl

causticl=$root/build/causticl
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# A cache of its own, for what is left over there counts too.
export CAUSTICL_CACHE_DIR=$work/cache TMPDIR=$work/tmp
mkdir "$work/tmp"
scene=$root/scenes/furnace.json
options=(--size 48x32 --photons 2000 --quiet)

# render_to FOLDER [PASSES]: sets `command`.
render_to() {
  command=("$causticl" render "$scene" "${options[@]}" --passes "${2:-8}" -o "$1/a.png" -o "$1/a.exr" -o "$1/a.pfm")
}
render() {
  render_to "$@"
  "${command[@]}"
}

milliseconds() { echo $(($(date +%s%N) / 1000000)); }

# kill_after MILLISECONDS: whether `command` was killed rather than done before.
kill_after() {
  local wait=$1 status=0 child
  # Not a function: that would be a shell, killed in place of the program.
  "${command[@]}" >"$work/said" 2>&1 &
  child=$!
  sleep "$(printf '%d.%03d' $((wait / 1000)) $((wait % 1000)))"
  kill -9 "$child" 2>/dev/null || true
  { wait "$child" || status=$?; } 2>/dev/null
  [ $status -eq 0 ] || [ $status -eq 137 ] || fail "a run that was to be killed ended with $status: $(cat "$work/said")"
  [ $status -eq 137 ]
}

# What a killed process leaves behind is removed by a later one that is sure that nobody writes it: some know by a
# lock, some by its age. So it is made old.
make_old() { find "$@" -depth -exec touch -h -d '2 days ago' {} +; }

# Fails where a folder holds more than the given names.
holds_only() {
  local folder=$1 name
  shift
  while IFS= read -r name; do
    [[ " $* " == *" $name "* ]] || fail "left over after the next run: $folder/$name"
  done < <(ls -A "$folder")
}

holds_no_run_folder() {
  local left
  left=$(find "$work/cache" "$work/tmp" \( -name 'causticl-run-*' -o -name '.causticl-*' \) | head -1)
  [ -z "$left" ] || fail "left over after the next run: $left"
}

# Pictures are written after 1, 2 and 4 passes too: any of these is whole.
mkdir "$work/out" "$work"/whole{1,2,4,8}
for passes in 1 2 4 8; do render "$work/whole$passes" $passes; done # the first compiles the kernels
begin=$(milliseconds)
render "$work/whole8"
span=$(($(milliseconds) - begin))

is_whole() {
  local file=$work/out/$1 passes
  [ -e "$file" ] || return 0
  case $1 in
    # Its metadata hold times, so that no two are the same.
    *.exr) "$causticl" compare "$file" "$work/whole8/a.pfm" >"$work/said" && return ;;
    *) for passes in 1 2 4 8; do cmp -s "$file" "$work/whole$passes/$1" && return; done ;;
  esac
  fail "$1 is damaged after a kill"
}

killed=0
for ((i = 0; i < renders; ++i)); do
  # Half of the kills fall into the last tenth, where files are written.
  if ((i % 2)); then wait=$((span * 9 / 10 + span * (i % 40) / 200)); else wait=$((span * (i % 100) / 100)); fi
  render_to "$work/out"
  if kill_after "$wait"; then killed=$((killed + 1)); fi
  for name in a.png a.exr a.pfm; do is_whole "$name"; done
  ((i % 20 == 19)) || continue
  make_old "$work/out" "$work/cache" "$work/tmp"
  render "$work/out" || fail "the run after a killed one failed"
  for name in a.png a.exr a.pfm; do
    [ -e "$work/out/$name" ] || fail "the run after a killed one wrote no $name"
    [ "$name" = a.exr ] || cmp -s "$work/out/$name" "$work/whole8/$name" || fail "$name is not what it was"
    is_whole "$name"
  done
  holds_only "$work/out" a.png a.exr a.pfm
  holds_no_run_folder
  rm -rf "$work/out"
  mkdir "$work/out"
done
echo "renders: $renders runs, $killed killed before their end; no damaged file, nothing left over, the next runs work"

# Sets `command` to a study of so many seconds.
study_of() {
  command=("$causticl" study "$scene" --size 24x16 --parameters "max_depth,alpha" --seeds 2 --budget "$1" --quiet -o "$work/study")
}

check_study() {
  local picture
  for picture in "$work/study/reference.exr" "$work/study/pictures"/*.exr; do
    [ ! -e "$picture" ] || "$causticl" compare "$picture" "$picture" >"$work/said" ||
      fail "$picture is damaged after a kill"
  done
}

killed=0
for ((i = 0; i < studies; ++i)); do
  study_of 450
  if kill_after $((100 + 5900 * (i % 25) / 25)); then killed=$((killed + 1)); fi
  [ ! -d "$work/study" ] || check_study
  ((i % 25 == 24)) || continue
  make_old "$work/study" "$work/cache" "$work/tmp"
  # What the killed ones spent counts: a new budget is left for the rest.
  study_of 45
  "${command[@]}" >"$work/said" 2>&1 || fail "the study after a killed one failed: $(cat "$work/said")"
  for name in study.csv study.html; do [ -s "$work/study/$name" ] || fail "the study after a killed one wrote no $name"; done
  left=$(find "$work/study" -name '.*' ! -path "$work/study" | head -1)
  [ -z "$left" ] || fail "left over after the next study: $left"
  holds_no_run_folder
  rm -rf "$work/study"
done
echo "studies: $studies runs, $killed killed before their end; no damaged file, nothing left over, the next runs work"
