# What the scripts share; to be sourced, not run. The packages that a build needs, and the build.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)

build_packages=(g++ cmake ninja-build pkg-config ocl-icd-opencl-dev opencl-c-headers opencl-clhpp-headers
  pocl-opencl-icd nlohmann-json3-dev libstb-dev libopenexr-dev libxxhash-dev libcli11-dev)
test_packages=(catch2 clang-format python3-jsonschema)
lint_packages=(clang-tidy)
fuzz_packages=(clang libclang-rt-dev llvm)
bench_packages=(libembree-dev)
page_packages=(chromium python3)

fail() {
  echo "error: $*" >&2
  exit 1
}

# Installs those of the named Debian packages that are missing; says nothing where none is.
set_up() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    set_up_elsewhere
    return
  fi
  local installed package missing=()
  installed=" $(dpkg-query -W -f='${db:Status-Status}:${Package} ' "$@" 2>/dev/null || true)"
  for package in "$@"; do
    [[ $installed == *" installed:$package "* ]] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
      as_root=(sudo)
    else
      fail "packages are missing and this user cannot install them. As root, run:
  apt-get install ${missing[*]}"
    fi
  fi
  echo "Installing from Debian's packages (this can take minutes): ${missing[*]}" >&2
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 apt-get -qq -o Dpkg::Use-Pty=0)
  # A failed update may still leave lists that serve. What goes wrong is said on stderr.
  "${apt[@]}" update >/dev/null || true
  "${apt[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null >/dev/null ||
    fail "the packages could not be installed: ${missing[*]}"
}

# Without Debian's package tools nothing is installed: says what is needed where a build cannot even start.
set_up_elsewhere() {
  local tool missing=()
  for tool in c++ cmake ninja pkg-config; do
    command -v "$tool" >/dev/null || missing+=("$tool")
  done
  [ ${#missing[@]} -eq 0 ] || fail "not found: ${missing[*]}. This is no Debian system, so please install by its own means
  a C++20 compiler, CMake 3.18, Ninja, pkg-config, an OpenCL ICD loader with C and C++ headers (CLHPP) and a
  driver such as PoCL, nlohmann-json 3.10, stb, OpenEXR 3, CLI11, xxHash 0.8; for the tests also Catch2 2.13 and Python 3 with jsonschema."
}

# build FOLDER TARGET [CMAKE_OPTION...]: configures where needed and builds; says nothing where all is done.
build() {
  local folder=$root/$1 target=$2 options=(-DCMAKE_EXPORT_COMPILE_COMMANDS=ON "${@:3}")
  [[ " $* " == *" -DCMAKE_BUILD_TYPE="* ]] || options+=(-DCMAKE_BUILD_TYPE=Release)
  # A tree that was moved or copied brings a folder that CMake refuses.
  if [ -f "$folder/CMakeCache.txt" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    rm -rf "$folder"
  fi
  local configured=true option
  [ -f "$folder/build.ninja" ] || configured=false
  for option in "${options[@]#-D}"; do # NAME=VALUE stands as NAME:TYPE=VALUE in the cache
    grep -qE "^${option%%=*}:[A-Z]+=${option#*=}$" "$folder/CMakeCache.txt" 2>/dev/null || configured=false
  done
  if ! $configured; then
    local messages
    messages=$(cmake -S "$root" -B "$folder" -G Ninja "${options[@]}" 2>&1) ||
      fail "CMake could not configure the build:"$'\n'"$messages"
  fi
  # What ninja says when it finds nothing to do is left out.
  ninja -C "$folder" "$target" </dev/null | { grep --line-buffered -vE '^ninja: (Entering|no work)|Re-checking' || true; } >&2 ||
    fail "the build failed"
}
