#!/usr/bin/env bash
# Builds condyle, sweeps the phantom knee from 0 to 120 degrees and draws it: everything goes into out/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
install_npm_where_possible
# With its manual: what is built here can be installed (cmake --install build).
for target in condyle condyle_manual; do TARGET=$target build build -DCMAKE_BUILD_TYPE=Release; done

mkdir -p out
build/condyle sweep data/phantom/knee.toml -o out/phantom.h5
build/condyle render out/phantom.h5 -o out
build/condyle plot out/phantom.h5 -o out
build/condyle report out/phantom.h5 -o out/phantom.html
echo "Open out/phantom.html in a browser: the knee in three dimensions, its pictures, curves and tables."
