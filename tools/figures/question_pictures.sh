#!/usr/bin/env bash
# Draws the pictures of docs/questions.md anew into docs/images (or a folder that is named). Needs ffmpeg, which puts two
# pictures side by side and keeps them small.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch
to=${1:-docs/images}

# Warnings of the knees that ship, and exit code 2 of a pose beyond an edge, are what the pictures are about.
run() { "$CONDYLE" "$@" --quiet 2>"$out/said" || [ $? -eq 2 ] || { cat "$out/said" >&2; exit 1; }; }

# small PNG PICTURE...: side by side, each cut by $cut, in 200 colours.
small() {
  local png=$1 inputs=() chain='' names='' i=0
  shift
  for picture in "$@"; do
    inputs+=(-i "$picture")
    chain+="[$i]${cut:-null}[c$i];" names+="[c$i]" i=$((i + 1))
  done
  [ $i -eq 1 ] && chain+="${names}null[all]" || chain+="${names}hstack=inputs=${i}[all]"
  ffmpeg -loglevel error -y "${inputs[@]}" \
    -filter_complex "$chain;[all]split[x][y];[x]palettegen=max_colors=200[p];[y][p]paletteuse=dither=none" "$to/$png"
}

run sweep data/phantom/knee.toml -o "$out/far.h5" --from 90 --to 150
run render "$out/far.h5" -o "$out/edge.png" --at 135 --view condyles --size 900x675
small edge_135.png "$out/edge.png"

mkdir "$out/data" "$out/good" "$out/bad"
ln -s "$PWD/meshes" "$out/meshes"
sed 's#"\.\./\.\./meshes#"../meshes#; s/^compartment = "medial"/&\nfit = { smoothing = 12 }/' data/phantom/knee.toml \
  >"$out/data/smooth.toml"
run fit data/phantom/knee.toml -o "$out/fit.h5" --pictures "$out/good"
run fit "$out/data/smooth.toml" -o "$out/fit.h5" --pictures "$out/bad"
small fit_good_bad.png "$out/good/medial_plateau_deviation.png" "$out/bad/medial_plateau_deviation.png"

run sweep data/phantom/knee.toml -o "$out/straight.h5"
run sweep data/phantom/wrapped.toml -o "$out/wrapped.h5"
for knee in straight wrapped; do
  run render "$out/$knee.h5" -o "$out/$knee.png" --at 30 --view posterior --size 900x675
done
cut=crop=780:586:0:0 small straight_wrapped.png "$out/straight.png" "$out/wrapped.png"

run sweep data/phantom/layered.toml -o "$out/layered.h5"
cp "$out/straight.h5" "$out/rigid.h5"
run plot "$out/rigid.h5" "$out/layered.h5" -o "$out"
small layers_forces.png "$out/contact_forces.png"
