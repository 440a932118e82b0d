#!/usr/bin/env bash
# Wismans' model beside ours on the shipped knees, and their drawer tests. Results, plots and pictures of the plateau go
# into out/wismans.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/figures/program.sh

mkdir -p out/wismans

for knee in wismans-type phantom; do
  folder=out/wismans/$knee
  mkdir -p "$folder"
  # Exit code 2: some pose did not succeed, and the program has said which.
  "$CONDYLE" compare "data/$knee/knee.toml" -o "$folder/compare.h5" || [ $? -eq 2 ]
  "$CONDYLE" laxity "data/$knee/drawer.toml" -o "$folder/laxity.h5" || [ $? -eq 2 ]
  "$CONDYLE" plot "$folder/compare.h5" -o "$folder"
  "$CONDYLE" plot "$folder/laxity.h5" -o "$folder"
  "$CONDYLE" render "$folder/compare.h5" -o "$folder" --view plateau
done
