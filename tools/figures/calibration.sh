#!/usr/bin/env bash
# What fits of knees to made measurements give back of a truth that is known: tables of docs/calibration.md.
#
#   tools/figures/calibration.sh exact|spring|wrong|phantom|lenhart [DRAWS]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
figures=$(dirname "$CONDYLE")/condyle_calibration_figures
[ -x "$figures" ] || cmake --build "$(dirname "$CONDYLE")" --target condyle_calibration_figures >/dev/null
[ "$1" != lenhart ] || needs "$specimens/lenhart2015/knee.toml"
"$figures" . --parts "$1" ${2:+--draws "$2"}
