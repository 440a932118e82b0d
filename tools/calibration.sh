#!/usr/bin/env bash
# Fits knees whose truth is known to made measurements and writes what comes back, with the time a fit takes, into
# docs/calibration.md. About a quarter of an hour on two cores.
#
#   tools/calibration.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
TARGET=condyle build build -DCMAKE_BUILD_TYPE=Release >/dev/null
TARGET=condyle_calibration_figures build build >/dev/null
CONDYLE=$PWD/build/condyle tools/figures.sh --write docs/calibration.md
