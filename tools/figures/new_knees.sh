#!/usr/bin/env bash
# Scenes that `condyle new` makes of knees whose frames and insertions are known, as rows of a table: side and how sure it is,
# how far frames and insertions lie from those given, poses of a sweep from 0 to 120 degrees, those that verify finds false.
#
#   tools/figures/new_knees.sh frames|insertions
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch
errors=$(dirname "$CONDYLE")/condyle_compare_scenes
[ -x "$errors" ] || cmake --build "$(dirname "$CONDYLE")" --target condyle_compare_scenes >/dev/null

ssm=$specimens/clouthier2019_ssm lenhart=$specimens/lenhart2015 oai=$specimens/oai_pymskt
needs "$ssm/knee.toml" "$ssm/population/S001.toml" "$lenhart/knee.toml" "$oai/femur_bone.ply"

# field FILE KEY...: of what the program printed.
side() { sed -nE 's/^side +([a-z]+), ([0-9.]+) %.*/\1 \2/p' "$1"; }

# knee NAME GIVEN TEMPLATE FEMUR TIBIA [CARTILAGE...]: GIVEN is the scene with what is known, or -.
knee() {
  local name=$1 given=$2 model=$3 femur=$4 tibia=$5 template=() words='- - - - - - - -'
  shift 5
  [ "$model" = phantom ] || template=(--template "$model")
  if ! "$CONDYLE" new "$femur" "$tibia" ${1:+--cartilage "$@"} "${template[@]}" -o "$out/new.toml" >"$out/new.txt" 2>"$out/error.txt"; then
    printf '| %s | refused: %s |\n' "$name" "$(head -1 "$out/error.txt")"
    return
  fi
  [ "$given" = - ] || words=$("$errors" "$given" "$out/new.toml")
  "$CONDYLE" sweep "$out/new.toml" -o "$out/new.h5" --json >"$out/sweep.json" 2>/dev/null || true
  local false=0
  "$CONDYLE" verify "$out/new.h5" >"$out/verify.txt" 2>/dev/null || false=$?
  local poses
  poses=$(sed -nE 's/.*"converged": ([0-9]+).*/\1/p' "$out/sweep.json" | head -1)
  # shellcheck disable=SC2086
  set -- $words
  printf '| %s | %s | %s° %s mm | %s° %s mm | %s | %s | %s | %s of 25 | %s |\n' "$name" "$(side "$out/new.txt" | sed 's/$/ %/')" \
    "$1" "$2" "$3" "$4" "$6" "$7" "${*:8}" "${poses:-?}" "$([ "$false" -eq 2 ] && echo yes || echo none)"
}

for model in phantom "$ssm/knee.toml"; do
  printf '\nTemplate: %s\n\n' "$([ "$model" = phantom ] && echo phantom || echo "Clouthier's mean")"
  printf '| knee | side, sure | femur: axes, origin off | tibia | insertions off, mm rms | worst, mm | which | poses | false |\n|---|---|---|---|---|---|---|---|---|\n'
  knee Lenhart "$lenhart/knee.toml" "$model" "$lenhart"/lenhart2015-R-{femur,tibia}-subchondral-bone.stl "$lenhart"/ACLC01-R-{femur,tibia}-cart.obj
  knee 'Lenhart, bare' "$lenhart/knee.toml" "$model" "$lenhart"/lenhart2015-R-{femur,tibia}-subchondral-bone.stl
  knee OAI tests/data/oai_pymskt.toml "$model" "$oai"/{femur,tibia}_bone.ply "$oai"/femur_cartilage.ply "$oai"/tibia_cartilage_{medial,lateral}.ply
  [ "$model" != phantom ] || knee "Clouthier's mean" "$ssm/knee.toml" phantom "$ssm"/mean_{Femur,Tibia_shifted}.ply "$ssm"/mean_{Femur_Cartilage,Tibia_Cartilage_shifted}.ply
  for scene in "$ssm"/population/S*.toml; do
    s=${scene%.toml}
    knee "$(basename "$s")" "$scene" "$model" "$s"_{Femur,Tibia,Femur_Cartilage,Tibia_Cartilage}.ply
  done
done
