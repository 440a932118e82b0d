#!/usr/bin/env bash
# What `condyle new` makes of bones without their cartilage: poses of a sweep from 0 to 120 degrees by 5 that are found and true,
# with the meshes of the cartilage, without them, and without them on condyles that end at their sides as those of cartilage do.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch
oai=$specimens/oai_pymskt model=$specimens/clouthier2019_ssm
needs "$oai/femur_bone.ply" "$model/population/S001_Femur.ply"

# poses SCENE: how many are found, and how many of them are false.
poses() {
  "$CONDYLE" sweep "$1" -o "$out/run.h5" --quiet 2>/dev/null || [ $? -eq 2 ]
  { "$CONDYLE" verify "$out/run.h5" --json 2>/dev/null || [ $? -eq 2 ]; } | awk -F '[:,]' '
    /"counts"/ { inside = 1 }
    inside { gsub(/[" ]/, "", $1); count[$1] = $2 + 0 }
    inside && /}/ { exit }
    END { printf "%d of %d%s", count["converged"], count["poses"], count["false"] ? ", " count["false"] " false" : "" }'
}

# knee NAME FEMUR TIBIA [FEMORAL TIBIAL...]: a row.
knee() {
  local name=$1 with=-
  "$CONDYLE" new "$2" "$3" -o "$out/bare.toml" >/dev/null 2>&1
  grep -v '^region = { least_cosine = 0 }' "$out/bare.toml" >"$out/narrow.toml"
  if [ $# -gt 3 ]; then
    "$CONDYLE" new "$2" "$3" --cartilage "${@:4}" -o "$out/cartilage.toml" >/dev/null 2>&1
    with=$(poses "$out/cartilage.toml")
  fi
  printf '| %s | %s | %s | %s |\n' "$name" "$with" "$(poses "$out/bare.toml")" "$(poses "$out/narrow.toml")"
}

printf '| knee | with its cartilage | bones alone | bones, narrow condyles |\n|---|---|---|---|\n'
knee OAI "$oai"/{femur,tibia}_bone.ply "$oai"/{femur_cartilage,tibia_cartilage_lateral,tibia_cartilage_medial}.ply
knee "Clouthier's mean" "$model"/mean_{Femur,Tibia_shifted,Femur_Cartilage,Tibia_Cartilage_shifted}.ply
for k in S001 S010 S020 S030 S040 S060 S080 S100; do
  knee $k "$model/population/$k"_{Femur,Tibia,Femur_Cartilage,Tibia_Cartilage}.ply
done
