#!/usr/bin/env bash
# Measures what a position of equilibrium costs (docs/equilibrium.md, Speed). Arguments go to the benchmark program:
# --benchmark_filter=pose, --benchmark_repetitions=5 ...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
TARGET=condyle_benchmark build build -DCMAKE_BUILD_TYPE=Release >/dev/null
build/condyle_benchmark "$@" 2>/dev/null
