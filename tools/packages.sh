# shellcheck shell=bash
# Sourced by run.sh and test.sh: the Debian packages that condyle is built from, and the way to get them.
# Only what is missing is installed; where there is no apt the list is shown and CMake has the last word.

build_packages=(
  cmake g++ make pkg-config
  libeigen3-dev libassimp-dev libnanoflann-dev libhdf5-dev libtomlplusplus-dev libfmt-dev libcli11-dev
  libosmesa6-dev libpng-dev libfreetype-dev fonts-dejavu-core gnuplot-nox
  libtinygltf-dev nlohmann-json3-dev libmeshoptimizer-dev libpugixml-dev
  libsundials-dev libceres-dev librandom123-dev libboost-dev libssl-dev libgtest-dev libbenchmark-dev hdf5-tools python3-h5py
  pybind11-dev python3-dev python3-numpy
)

missing_packages() {
  local package
  for package in "${build_packages[@]}"; do
    dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2>/dev/null | grep -x installed >/dev/null ||
      echo "$package"
  done
}

install_packages() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "No apt here. Needed (Debian names): ${build_packages[*]}" >&2
    echo "Going on with what CMake finds." >&2
    return 0
  fi
  local missing
  mapfile -t missing < <(missing_packages)
  [ "${#missing[@]}" -gt 0 ] || return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Missing packages: ${missing[*]}" >&2
      echo "Install them as root: apt-get install ${missing[*]}" >&2
      echo "Going on with what CMake finds." >&2
      return 0
    fi
    as_root=(sudo)
  fi
  echo "Installing: ${missing[*]}"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 -qq)
  # The lists are fetched only where they do not know a package yet.
  "${apt[@]}" install --yes --no-install-recommends "${missing[@]}" >/dev/null 2>&1 || {
    update_package_lists "${apt[@]}"
    "${apt[@]}" install --yes --no-install-recommends "${missing[@]}" >/dev/null
  }
}

# install_where_possible PACKAGE...: what a study compares with; without it the study does without.
install_where_possible() {
  local build_packages=("$@")
  install_packages || echo "Going on without: $*" >&2
}

# npm bundles the 3-D view of reports; without it they go without. Debian's own is taken only where there is no other, as
# one of another origin and Debian's do not stand beside each other.
install_npm_where_possible() {
  command -v node >/dev/null && command -v npm >/dev/null || install_where_possible nodejs npm
}

# apt waits for a busy package lock by itself, but not for the lock of its lists.
update_package_lists() {
  local attempt
  for attempt in $(seq 60); do
    "$@" update && return 0
    echo "The package lists are busy or out of reach; trying again ($attempt of 60)." >&2
    sleep 10
  done
  return 1
}

# build FOLDER [CMAKE ARGUMENT...]: configures where needed and builds everything, quietly while all is well.
# TARGET, where set, is built alone; it may be several.
build() {
  local folder=$1
  shift
  cmake -S . -B "$folder" "$@" >/dev/null
  cmake --build "$folder" --parallel "$(nproc)" ${TARGET:+--target $TARGET}
}
