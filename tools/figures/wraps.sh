#!/usr/bin/env bash
# The Lenhart knee of OpenSim-JAM with all its strands, as imported: 24 of 55 wrap. Rows of a table: sweeps of 0 to 120 degrees by 5
# at three loads, with rigid contacts and with the model's layers, verified, and the same downwards.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch
source tools/figures/lenhart.sh

# swept NAME FROM TO STEP
swept() {
  "$CONDYLE" sweep "$out/scene.toml" -o "$out/$1.h5" --from "$2" --to "$3" --step "$4" >"$out/$1.log" 2>&1 || [ $? -eq 2 ]
  "$CONDYLE" export "$out/$1.h5" -o "$out/$1.csv" >/dev/null 2>&1 || [ $? -eq 2 ]
}
# Greatest difference of poses [mm, rad counted as degrees] and of ligament lengths [mm] between two runs.
differences() {
  awk -F, '
    FNR == 1 { file++; next }
    $4 == "pose" || ($4 == "ligament" && $6 == "length") {
      key = $2 " " $4 " " $5 " " $6
      if (file == 1) { at[key] = $7; next }
      if (!(key in at)) next
      d = $7 - at[key]; if (d < 0) d = -d
      if (d > most) most = d }
    END { printf "%.0e", most }' "$out/up.csv" "$out/down.csv"
}

printf '| load | contacts | poses of 25 | false | events of wraps | up and down, at most |\n|---|---|---|---|---|---|\n'
for load in 50 100 300; do
  for law in rigid layer; do
    sed -E "s/^vector = \[0, 100, 0\]/vector = [0, $load, 0]/" "$out/imported.toml" >"$out/scene.toml"
    [ $law = layer ] || sed -i '/^law = "layer"/d' "$out/scene.toml"
    swept up 0 120 5
    swept down 120 0 -5
    poses=$(sed -nE 's/^([0-9]+) of 25 poses converged.*/\1/p' "$out/up.log")
    false=0
    "$CONDYLE" verify "$out/up.h5" >"$out/verify.log" 2>&1 || false=$(sed -nE 's/.*, ([0-9]+) of them (is|are) false/\1/p' "$out/verify.log")
    events=$(grep -cE " on .*: (touching|lifting off) at" "$out/up.log" || true)
    off=$(differences)
    printf '| %s N | %s | %s | %s | %s | %s |\n' "$load" "$law" "$poses" "$false" "$events" \
      "$(awk -v d="$off" 'BEGIN { print d <= 1e-9 ? "1e-9" : d }')"
  done
done
