#!/usr/bin/env bash
# One shipped scene for each status that a pose may have, changed so that it fails, and what the program says of the first
# pose that does: the examples of docs/questions.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch
ln -s "$PWD/meshes" "$out/meshes"
mkdir "$out/data"

# failing WHAT SCENE [SED EXPRESSION | +TEXT]... -- [OPTION]...: sweeps the changed scene.
failing() {
  local what=$1 scene="$out/data/scene.toml" said
  sed 's#"\.\./\.\./meshes#"../meshes#' "$2" >"$scene"
  shift 2
  while [ "$1" != -- ]; do
    case $1 in
      +*) printf '\n%b\n' "${1#+}" >>"$scene" ;;
      *) sed -i "$1" "$scene" ;;
    esac
    shift
  done
  shift
  said=$("$CONDYLE" sweep "$scene" -o "$out/run.h5" --quiet "$@" 2>&1 || [ $? -eq 2 ])
  printf '%s:\n    %s\n\n' "$what" "$(sed -n 's/^condyle: \(.* = .*\)/\1/p' <<<"$said" | head -1)"
}

phantom=data/phantom/knee.toml
printf '\n'
failing 'The phantom, flexed to 160 degrees' "$phantom" -- --from 100 --to 160
failing 'The phantom under 20,000 N (a load given in millinewtons)' "$phantom" 's/\[0, 80, 0\]/[0, 20000, 0]/' -- --to 0
failing 'The phantom without its ligaments' "$phantom" '/^\[\[ligament\]\]/,/^$/d' -- --from 60 --to 60
failing 'Layers of 1 N/mm² under 1,000 N' data/phantom/layered.toml 's/^modulus = .*/modulus = 1/' \
  's/\[0, 80, 0\]/[0, 1000, 0]/' -- --to 0
failing 'A start pose with the tibia 60 mm too high, within the femur' "$phantom" \
  's/^start.translation = .*/start.translation = [0, 60, 0]/' -- --to 0
failing 'A start pose with the tibia 400 mm too low' "$phantom" 's/^start.translation = .*/start.translation = [0, -400, 0]/' -- --to 0
failing 'Flexion prescribed twice' "$phantom" \
  '+[[condition]]\nname = "extension"\nkind = "flexion"\nvalue = 10' -- --to 0
failing 'A string that has to go through a ring' "$phantom" \
  '+[[wrap]]\nname = "ring"\nbody = "femur"\nkind = "torus"\ncenter = [0, -20, 0]\naxis = [0, 0, 1]\nmajor = 20\nminor = 5' \
  '+[[ligament]]\nname = "string"\nends = [ { body = "femur", at = [-20, 45, 0] }, { body = "tibia", at = [-8, -60, 0] } ]' \
  '+law = "toe-linear"\nstiffness = 100\nslack_length = 60\nwraps = ["ring"]' -- --to 0
failing 'A spring whose two ends meet' data/hard/short-element.toml --
