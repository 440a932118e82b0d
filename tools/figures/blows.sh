#!/usr/bin/env bash
# Peaks of the blows of tools/blows.sh as a table, the durations of a force in one row.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh

printf '| blow | peak flexion [deg] | medial [N] | lateral [N] | impacts |\n|---|---|---|---|---|\n'
tools/blows.sh | awk '
  function flush() { if (hits ~ /^0( \/ 0)*$/) hits = 0
    if (newton) printf "| %s, %s ms | %s | %s | %s | %s |\n", newton, ms, a, b, c, hits; newton = "" }
  function add(list, x) { return list == "" ? x : list " / " x }
  /^[0-9]+N-/ {
    split($1, part, /N-|ms/)
    if (part[1] " N" != newton) { flush(); newton = part[1] " N"; ms = a = b = c = hits = "" }
    ms = add(ms, part[2]); a = add(a, sprintf("%.0f", $2)); b = add(b, sprintf("%.0f", $3))
    c = add(c, sprintf("%.0f", $4)); hits = add(hits, $5)
  }
  /^sine/ { flush(); printf "| decaying sine, 100 N | %.0f | %.0f | %.0f | %s |\n", $2, $3, $4, $5 }'
