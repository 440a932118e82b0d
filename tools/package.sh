#!/usr/bin/env bash
# Builds condyle and packs it for Debian: out/condyle_VERSION_ARCH.deb, the program, and out/libcondyle-dev_VERSION_ARCH.deb,
# the libraries.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
install_npm_where_possible
install_where_possible dpkg-dev
for target in condyle condyle_manual; do TARGET=$target build build -DCMAKE_BUILD_TYPE=Release; done
mkdir -p out
packages=$PWD/out
(cd build && cpack -G DEB -B "$packages" >/dev/null)
rm -rf out/_CPack_Packages
ls out/*.deb
