#!/usr/bin/env bash
# Ellipsoids fitted to bones, as rows of a table: how far the mesh lies from them, and by how much strings over them differ from
# the shortest ones over the mesh; superficial MCL on the tibia, medial and lateral posterior capsule on the femur.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch

# row KNEE SCENE BODY LIGAMENTS WHAT: LIGAMENTS is a regular expression for their names.
row() {
  local folder
  folder=$(cd "$(dirname "$2")" && pwd)
  sed -E "s#^mesh = \"([^/][^\"]*)\"#mesh = \"$folder/\1\"#" "$2" | awk -v body="$3" -v names="^name = \"($4)\"" '
    /^\[\[ligament\]\]/ && !done {
      printf "[[wrap]]\nname = \"bone\"\nbody = \"%s\"\nkind = \"ellipsoid\"\nfit = \"bone\"\n\n", body
      done = 1
    }
    { print }
    $0 ~ names { print "wraps = [\"bone\"]" }' >"$out/scene.toml"
  "$CONDYLE" check "$out/scene.toml" | awk -v knee="$1" -v what="$5" '
    /^wrap "bone"/ {
      gsub(/[,;]/, "")
      printf "| %s | %s | %s | %s %s %s | %s (%s) | %s (%s) |\n", knee, what, strings($0), $6, $7, $8, $12, $16, part($0, 1), part($0, 2)
    }
    function strings(line) { match(line, /[0-9]+ strings strings/); return substr(line, RSTART, RLENGTH) + 0 }
    function part(line, i, words) {
      sub(/.* the mesh by /, "", line)
      split(line, words, " ")
      return i == 1 ? words[1] : words[4]
    }'
}

folder=$specimens/clouthier2019_ssm
needs "$folder/knee.toml" "$folder"/population/S001.toml
printf '| knee | ligaments | strings | semi-axes mm | mesh off it, mm rms (worst) | lengths over it, mm rms (worst) |\n'
printf '|---|---|---|---|---|---|\n'
for scene in "$folder/knee.toml" "$folder"/population/S*.toml; do
  knee=$(basename "$scene" .toml)
  row "${knee/knee/mean}" "$scene" tibia 'MCLs[0-9]' 'superficial MCL'
  row "${knee/knee/mean}" "$scene" femur 'pCAP[157]' 'medial capsule'
  row "${knee/knee/mean}" "$scene" femur 'pCAP[268]' 'lateral capsule'
done
