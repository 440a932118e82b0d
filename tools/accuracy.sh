#!/usr/bin/env bash
# Measures what an answer costs and how wrong it is, and writes out/accuracy: the page docs/accuracy.md with the figures of
# this run, tables (CSV) and plots (PNG). KINSOL and Ceres stand beside ours where they are installed.
#
#   tools/accuracy.sh [--docs] [STUDY...]
#
# STUDY: surfaces, smoothing, solver, way, parts, growth, hard; all where none is named, about five minutes after the
# build. --docs: the page and its plots also go into docs. Ends with 2 where something that should hold does not.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

into_docs=
if [ "${1:-}" = --docs ]; then
  shift
  into_docs=yes
fi

install_packages
install_where_possible libceres-dev libsundials-dev
TARGET=condyle build build -DCMAKE_BUILD_TYPE=Release >/dev/null
TARGET=condyle_accuracy build build >/dev/null

status=0
build/condyle_accuracy out/accuracy . "$@" || status=$?
[ "$status" -ne 1 ] || exit 1
mkdir -p out/accuracy/images
gnuplot -e "folder='out/accuracy'" tools/accuracy/plots.gp
echo "wrote out/accuracy"
if [ -n "$into_docs" ]; then
  cp out/accuracy/accuracy.md docs/accuracy.md
  cp out/accuracy/images/accuracy_*.png docs/images
  echo "wrote docs/accuracy.md and docs/images"
fi
exit "$status"
