#!/usr/bin/env bash
# What the 24 wrapped strands of the Lenhart knee add to a warm pose: contacts rigid, 0 to 120 degrees by 5 and back, stability told,
# beside the same strands straight, least of several runs in turns (docs/wrapping.md).
#
#   tools/wraps_cost.sh [RUNS]        7
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh
install_packages
TARGET="condyle condyle_benchmark" build build -DCMAKE_BUILD_TYPE=Release >/dev/null
CONDYLE=build/condyle
source tools/figures/program.sh
scratch
source tools/figures/lenhart.sh

CONDYLE_SCENE=$out/imported.toml build/condyle_benchmark --benchmark_filter=scene_pose --benchmark_repetitions="${1:-7}" \
  --benchmark_enable_random_interleaving=true --benchmark_format=csv 2>/dev/null |
  awk -F, '
    /^"scene_pose\/wraps:[01]"/ { wraps = $1 ~ /:1"/; if (!(wraps in least) || $4 + 0 < least[wraps]) least[wraps] = $4 + 0 }
    END {
      if (!(0 in least) || !(1 in least)) exit 1
      printf "| strands straight | 24 of them wrapped | they add |\n|---|---|---|\n"
      printf "| %.0f µs | %.0f µs | %.0f µs |\n", least[0], least[1], least[1] - least[0] }'
