#!/usr/bin/env bash
# The phantom fitted to laxity of the literature: what the program prints of data and errors.
#
#   tools/figures/phantom_calibration.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch
"$CONDYLE" calibrate data/phantom/calibrate.toml -o "$out/fit.h5" --samples 0 2>/dev/null |
  sed -n 's/^/    /; /starts reached the same/p; /directions are determined/p; /chi square/,/^    *$/p; /^    rms error/,/^    *$/p' | sed 's/ *$//'
