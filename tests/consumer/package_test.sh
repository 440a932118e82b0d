#!/usr/bin/env bash
# Makes the Debian packages of a build, looks into them, asks lintian where it is there, and uses them where root is allowed:
# in a root that holds nothing but what they depend on. package_test.sh BUILD_FOLDER. Ends with 77 where there is no
# dpkg-deb, or where not all is built that goes into them.
set -euo pipefail
build=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/consumer/clean_root.sh
source "$here/clean_root.sh"
command -v dpkg-deb >/dev/null || { echo "skipped: no dpkg-deb"; exit 77; }
command -v dpkg-shlibdeps >/dev/null || { echo "skipped: no dpkg-shlibdeps"; exit 77; }
for made in condyle libcondyle_mechanics.a libcondyle_io.a libcondyle_pictures.a src/condyle/app/condyle.1; do
  [ -e "$build/$made" ] || { echo "skipped: $build holds no $made"; exit 77; }
done
if grep -q '^CONDYLE_PYTHON_EXECUTABLE' "$build/CMakeCache.txt" && ! compgen -G "$build/python/condyle/_condyle.*.so" >/dev/null; then
  echo "skipped: $build holds no Python module yet"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$build" && cpack -G DEB -B "$work" >"$work/log" 2>&1) || { cat "$work/log"; exit 1; }

# expect PACKAGE FILE...: files that a package holds.
expect() {
  local package=$1 file
  shift
  dpkg-deb --contents "$package" | awk '{ print $6 }' >"$work/files"
  for file in "$@"; do
    grep -qE "^\./usr/$file\$" "$work/files" || { echo "$package holds no $file:" && cat "$work/files" && exit 1; }
  done
}
program=$(echo "$work"/condyle_*.deb) libraries=$(echo "$work"/libcondyle-dev_*.deb)
packages=("$program" "$libraries")
for package in "$work"/*.deb; do
  name=$(dpkg-deb --field "$package" Package)
  expect "$package" "share/doc/$name/copyright" "share/doc/$name/changelog\.gz"
done
expect "$program" bin/condyle share/man/man1/condyle\.1\.gz share/bash-completion/completions/condyle \
  share/condyle/data/phantom/knee.toml share/condyle/matlab/condyle_read_run.m share/condyle/matlab/private/struct_of_items.m
expect "$libraries" include/condyle/version.h include/condyle/build_info.h include/condyle/equilibrium/sweep.h \
  'lib/(.*/)?libcondyle_mechanics\.a' 'lib/(.*/)?libcondyle_io\.a' 'lib/(.*/)?cmake/condyle/condyleConfig\.cmake'
dpkg-deb --field "$program" Depends | grep libhdf5 >/dev/null || { echo "the program depends on no HDF5"; exit 1; }
module=$(echo "$work"/python3-condyle_*.deb)
if [ -e "$module" ]; then
  packages+=("$module")
  expect "$module" lib/python3/dist-packages/condyle/__init__.py 'lib/python3/dist-packages/condyle/_condyle\..*\.so'
  dpkg-deb --field "$module" Depends | grep 'python3 (>= 3.*python3-numpy' >/dev/null || { echo "the module depends on no Python"; exit 1; }
fi
for package in "${packages[@]}"; do
  dpkg-deb --field "$package" Package Version Architecture Section Depends
done

if command -v lintian >/dev/null; then
  root=()
  [ "$(id -u)" -ne 0 ] || root=(--allow-root)
  lintian "${root[@]}" --fail-on error,warning "${packages[@]}"
fi

# used RUN...: what an installed condyle does, each command run by RUN (a chroot, or nothing).
used() {
  "$@" condyle --version | grep '^build: ' >/dev/null || { echo "condyle does not tell how it was built"; return 1; }
  "$@" condyle sweep /usr/share/condyle/data/phantom/knee.toml -o /tmp/run.h5 --quiet
  "$@" condyle verify /tmp/run.h5 | tail -n 1
  if [ -e "$module" ]; then
    "$@" /usr/bin/python3 -c '
import condyle
run = condyle.sweep(condyle.read_scene("/usr/share/condyle/data/phantom/knee.toml"))
assert run.converged.all()
print(condyle.__file__, condyle.build_info())'
  fi
}

if [ "$(id -u)" -eq 0 ] && make_clean_root "$work/root" "${packages[@]}"; then
  mkdir -p "$work/root/packages"
  cp "${packages[@]}" "$work/root/packages"
  chroot "$work/root" sh -c 'dpkg --install --force-unsafe-io /packages/*.deb' >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  used chroot "$work/root"
  chroot "$work/root" dpkg --verify condyle
  chroot "$work/root" dpkg --remove condyle libcondyle-dev ${module:+$([ ! -e "$module" ] || echo python3-condyle)} >"$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
  for left in bin/condyle lib/python3/dist-packages/condyle; do
    [ ! -e "$work/root/usr/$left" ] || { echo "$left was removed and is still there"; exit 1; }
  done
  echo "used in a root of $(grep -c '^Package:' "$work/root/var/lib/dpkg/status") packages: what they depend on is all that they need"
else
  dpkg-deb --extract "$program" "$work/unpacked"
  "$work/unpacked/usr/bin/condyle" --version
  if [ -e "$module" ]; then
    dpkg-deb --extract "$module" "$work/unpacked"
    PYTHONPATH=$work/unpacked/usr/lib/python3/dist-packages /usr/bin/python3 -c 'import condyle; print(condyle.__file__)'
  fi
  echo "unpacked and started, not installed: that takes root"
fi
