#!/usr/bin/env bash
# Root mean square of the difference of Wismans' model from ours, and of ours with one thing of it, as rows of a table.
# compare.sh shipped|specimens
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch

# rows NAME SCENE TO QUANTITY...: flexion from 0 to TO
rows() {
  local name=$1 scene=$2 to=$3
  shift 3
  # Exit code 2: some pose did not succeed, which the page tells of.
  "$CONDYLE" compare "$scene" -o "$out/compare.h5" --from 0 --to "$to" >"$out/text" 2>/dev/null || [ $? -eq 2 ]
  for quantity; do
    awk -v name="$name, 0 to $to°" -v quantity="$quantity" '
      index($0, quantity) == 1 && $0 ~ /\|/ {
        unit = substr($0, length(quantity) + 1); sub(/^ +/, "", unit); sub(/ .*/, "", unit)
        form = unit == "N" ? "%.0f" : "%.2f"
        rms = substr($0, 37, 11); rest = $0; sub(/.*\|/, "", rest); split(rest, of, " ")
        printf "| %s | %s | " form "%s | " form " | " form " | " form " |\n", name, quantity, rms,
               unit == "deg" ? "°" : " " unit, of[1], of[2], of[3]
      }' "$out/text"
    name=
  done | sed 's/^| , 0 to [0-9]*° |/| |/'
}

printf '| knee, flexion | quantity | reference | surfaces alone | springs alone | closed alone |\n|---|---|---|---|---|---|\n'
rotation='internal rotation' drawer='anterior drawer' medial='medial contact force'
if [ "$1" = shipped ]; then
  rows Wismans-type data/wismans-type/knee.toml 90 "$rotation" "$drawer" "$medial"
  rows Wismans-type data/wismans-type/knee.toml 120 "$rotation" "$drawer"
  rows phantom data/phantom/knee.toml 115 "$rotation" "$drawer" "$medial"
else
  needs "$specimens"/{lenhart2015,clouthier2019_ssm}/knee.toml
  rows 'Lenhart 2015' "$specimens/lenhart2015/knee.toml" 90 "$rotation" "$medial"
  rows 'Clouthier 2019' "$specimens/clouthier2019_ssm/knee.toml" 90 "$rotation" "$medial"
fi
