#!/usr/bin/env bash
# Builds condyle and packs it for Debian: out/condyle_VERSION_ARCH.deb, the program, out/libcondyle-dev_VERSION_ARCH.deb,
# the libraries, and, where pybind11 is there, out/python3-condyle_VERSION_ARCH.deb, the module. Says what lintian finds in
# them: with a finding it ends with 1, without lintian it goes without.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
install_npm_where_possible
install_where_possible dpkg-dev lintian

# What is packed says so of itself; what stands in build/ afterwards is the developer's again.
as() { TARGET=$2 build build -DCMAKE_BUILD_TYPE=Release -DCONDYLE_MADE_BY="$1"; }
trap 'as cmake "$targets" >/dev/null' EXIT
targets=condyle
as "Debian package" "$targets"
if grep -q '^CONDYLE_PYTHON_EXECUTABLE' build/CMakeCache.txt; then targets="condyle condyle_python"; fi
for target in $targets condyle_manual condyle_pictures; do as "Debian package" "$target"; done

mkdir -p out
packages=$PWD/out
rm -f out/*condyle*.deb
(cd build && cpack -G DEB -B "$packages" >/dev/null)
rm -rf out/_CPack_Packages
ls out/*.deb
if ! command -v lintian >/dev/null; then
  echo "lintian is not here: nobody has looked at the packages"
  exit 0
fi
root=()
[ "$(id -u)" -ne 0 ] || root=(--allow-root)
# What it takes for misspelt words in a program are constants of machine code that stand side by side.
lintian "${root[@]}" --display-info --suppress-tags spelling-error-in-binary --fail-on error,warning,info out/*.deb
echo "lintian finds nothing"
