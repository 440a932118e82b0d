#!/usr/bin/env bash
# The shipped motions at three tolerances of the integrator, as a table; times are the fastest of RUNS (1).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch

# Layers of 3 mm, E = 10 N/mm², ν = 0.45, on all surfaces.
layers='s|^compartment.*|&\nmodulus = 10\npoisson = 0.45\nlayer = 3|; s|^surfaces = .*|&\nlaw = "layer"|'

# row LABEL SCENE TOLERANCE NOTE [EDIT]
row() {
  sed "s|= \"../../meshes|= \"$PWD/meshes|; s|^\[simulate\].*|&\ntolerance = $3|; ${5:-}" "data/phantom/$2.toml" >"$out/scene.toml"
  for ((run = 0; run < ${RUNS:-1}; run++)); do
    "$CONDYLE" simulate "$out/scene.toml" -o "$out/motion.h5" --json 2>/dev/null
  done | tr -d '",' | awk -v label="$1" -v tolerance="$3$4" '
    $1 == "simulation:" { inside = 1 }
    inside && ($1 != "seconds:" || !of[$1] || $2 < of[$1]) { of[$1] = $2 }
    $1 == "warnings:" { inside = 0 }
    END {
      balance = sprintf("%.0e", of["imbalance:"]); sub(/e-0/, "e-", balance)
      printf "| %s | %s | %d | %.0f ms | %s |\n", label, tolerance, of["steps:"], 1000 * of["seconds:"], balance
    }' | sed 's/^|  |/| |/'
}

printf '| scene | tolerance | steps | time | balance kept to, of the largest energy |\n|---|---|---|---|---|\n'
for scene in 'pendulum, 2 s' 'blow, 0.2 s' 'decaying-sine, 0.4 s'; do
  row "${scene/-/ }" "${scene%%,*}" 1e-5 ''
  row '' "${scene%%,*}" 1e-7 ''
  row '' "${scene%%,*}" 1e-9 ", the scene's own"
done
row 'pendulum on layers, 2 s' pendulum 1e-5 '' "$layers"
row '' pendulum 1e-7 '' "$layers"
row '' pendulum 1e-9 '' "$layers"
