#!/usr/bin/env bash
# Measures what an answer costs and how wrong it is, and writes out/accuracy: a page, tables (CSV) and plots (PNG).
# docs/accuracy.md holds the figures of one run. KINSOL and Ceres stand beside ours where they are installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
install_where_possible libceres-dev libsundials-dev
TARGET=condyle_accuracy build build -DCMAKE_BUILD_TYPE=Release >/dev/null
build/condyle_accuracy out/accuracy .
gnuplot -e "folder='out/accuracy'" tools/accuracy/plots.gp
echo "wrote out/accuracy"
