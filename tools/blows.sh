#!/usr/bin/env bash
# Strikes the phantom's shank with rectangular pulses of 20 to 140 N for 50 to 150 ms and with the decaying sine, the
# loading of the published impact studies (docs/network.md). Each blow is a scene and a run in out/blows; the table gives
# the peaks that the runs hold.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/figures/program.sh

mkdir -p "$OUT/blows"

# peak RUN DATASET: the largest number of a dataset
peak() { h5dump -y -w 1 -d "$2" "$1" | awk '/^ *-?[0-9.]+(e[-+]?[0-9]+)?,? *$/ { if ($1 + 0 > m) m = $1 + 0 } END { printf "%.1f", m }'; }

# strike NAME SCENE
strike() {
  local run=$OUT/blows/$1.h5 status=0
  "$CONDYLE" simulate "$2" -o "$run" >"$OUT/blows/$1.txt" 2>&1 || status=$?
  printf '%-14s %8s %10s %10s %10s %8s  %s\n' "$1" "$(peak "$run" /sweep/joint/flexion)" \
    "$(peak "$run" /sweep/contacts/medial/force)" "$(peak "$run" /sweep/contacts/lateral/force)" \
    "$(grep -c ' closes at ' "$OUT/blows/$1.txt" || true)" "$status" "$(grep -o "condyle: .*" "$OUT/blows/$1.txt" | grep -v axis: | tail -1)"
}

# pulse NEWTON MILLISECONDS
pulse() {
  local name=$1N-$2ms
  sed -e "s|= \"../../meshes|= \"$PWD/meshes|" -e "s/^vector = \[-50, 0, 0\]$/vector = [-$1, 0, 0]/" -e "s/duration = 0\.1 /duration = 0.$(printf %03d "$2") /" \
    -e 's/^time = .*/time = 0.3/' \
    -e "s/^title = .*/title = \"Phantom, right knee: $name\"/" data/phantom/blow.toml >"$OUT/blows/$name.toml"
  strike "$name" "$OUT/blows/$name.toml"
}

printf '%-14s %8s %10s %10s %10s %8s\n' 'blow' 'flexion' 'medial N' 'lateral N' 'impacts' 'exit'
for newton in 20 50 80 110 140; do
  for ms in 50 100 150; do pulse "$newton" "$ms"; done
done
strike sine data/phantom/decaying-sine.toml
