#!/usr/bin/env bash
# How sure a pose is, given a mesh: the phantom with roughness of known strengths against its exact surfaces, and what
# --uncertainty tells of it. A few minutes on two cores; position takes less.
#
#   tools/figures/uncertainty.sh auto|position
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
study=$(dirname "$CONDYLE")/condyle_roughness_study
[ -x "$study" ] || cmake --build "$(dirname "$CONDYLE")" --target condyle_roughness_study >/dev/null
if [ "$1" = auto ]; then
  "$study" data/phantom/knee.toml auto 40 10 20 0.05 0.1 0.2 0.4
else
  "$study" data/phantom/knee.toml position 40 0 20 0.05 0.1 0.2 0.4
fi
