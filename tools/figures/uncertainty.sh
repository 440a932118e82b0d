#!/usr/bin/env bash
# How sure a pose is, given a mesh: the phantom with roughness of four strengths against its exact surfaces, and what
# --uncertainty tells of it. About ten minutes on two cores; position takes one.
#
#   tools/figures/uncertainty.sh auto|position
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
study=$(dirname "$CONDYLE")/condyle_roughness_study
[ -x "$study" ] || cmake --build "$(dirname "$CONDYLE")" --target condyle_roughness_study >/dev/null
judged=10
[ "$1" = auto ] || judged=0
"$study" data/phantom/knee.toml "$1" 40 "$judged" 20 0.05 0.1 0.2 0.4
