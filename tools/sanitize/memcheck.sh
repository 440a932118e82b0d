#!/usr/bin/env bash
# The main job under valgrind's memcheck: a sweep of a shipped scene by the release program. Ends with 1 where memory is
# read before it is written, out of bounds or after its release, or lost. Prints what was run and how long it took.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/packages.sh
install_where_possible valgrind
source tools/figures/program.sh
scratch
SECONDS=0
for scene in data/wismans-type/knee.toml data/phantom/knee.toml; do
  valgrind --quiet --leak-check=full --errors-for-leak-kinds=definite,indirect,possible --error-exitcode=9 \
    "$CONDYLE" sweep "$scene" -o "$out/run.h5" >"$out/said" 2>"$out/log" || {
    cat "$out/log"
    exit 1
  }
  printf '    memcheck, condyle sweep %s: %s; nothing found; %s s\n' \
    "$scene" "$(grep -oE '[0-9]+ of [0-9]+ poses converged' "$out/said")" "$SECONDS"
  SECONDS=0
done
