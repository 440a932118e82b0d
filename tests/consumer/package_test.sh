#!/usr/bin/env bash
# Makes the Debian packages of a build and looks into them. package_test.sh BUILD_FOLDER. Ends with 77 where there is
# no dpkg-deb, or where not all is built that goes into them.
set -euo pipefail
build=$1
command -v dpkg-deb >/dev/null || { echo "skipped: no dpkg-deb"; exit 77; }
command -v dpkg-shlibdeps >/dev/null || { echo "skipped: no dpkg-shlibdeps"; exit 77; }
for made in condyle libcondyle_mechanics.a libcondyle_io.a libcondyle_pictures.a src/condyle/app/condyle.1; do
  [ -e "$build/$made" ] || { echo "skipped: $build holds no $made"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$build" && cpack -G DEB -B "$work" >"$work/log" 2>&1) || { cat "$work/log"; exit 1; }

# expect PACKAGE FILE...: files that a package holds.
expect() {
  local package=$1 file
  shift
  dpkg-deb --contents "$package" | awk '{ print $NF }' >"$work/files"
  for file in "$@"; do
    grep -qE "^\./usr/$file\$" "$work/files" || { echo "$package holds no $file:" && cat "$work/files" && exit 1; }
  done
}
program=$(echo "$work"/condyle_*.deb) libraries=$(echo "$work"/libcondyle-dev_*.deb)
expect "$program" bin/condyle share/man/man1/condyle.1 share/bash-completion/completions/condyle share/doc/condyle/copyright
expect "$libraries" include/condyle/version.h include/condyle/equilibrium/sweep.h 'lib/(.*/)?libcondyle_mechanics\.a' 'lib/(.*/)?libcondyle_io\.a' \
  'lib/(.*/)?cmake/condyle/condyleConfig\.cmake'
dpkg-deb --field "$program" Depends | grep -q libhdf5 || { echo "the program depends on no HDF5"; exit 1; }
for package in "$program" "$libraries"; do
  dpkg-deb --field "$package" Package Version Architecture Section Depends
done
dpkg-deb --extract "$program" "$work/root"
"$work/root/usr/bin/condyle" --version
