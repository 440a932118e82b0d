#!/usr/bin/env bash
# Measures what studies cost and whether they can be believed, makes the studies that ship, and writes docs/study.md. About half
# an hour on two cores that do nothing else.
#
#   tools/study.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
install_where_possible libopenmpi-dev openmpi-bin
TARGET=condyle build build -DCMAKE_BUILD_TYPE=Release >/dev/null
! cmake --build build --target help | grep condyle-mpi >/dev/null || TARGET=condyle-mpi build build >/dev/null
CONDYLE=$PWD/build/condyle tools/figures.sh --write docs/study.md
