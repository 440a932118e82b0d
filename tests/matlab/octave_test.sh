#!/usr/bin/env bash
# Reads a run of each kind under Octave with tools/matlab and compares every dataset with what h5py reads, to the last bit;
# and draws the examples without a display. octave_test.sh PROGRAM. Ends with 77 where something of it is not there.
set -euo pipefail
program=$(realpath "$1")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
python=/usr/bin/python3  # Debian's, which has its h5py
for needed in octave-cli h5dump gnuplot; do
  command -v "$needed" >/dev/null || { echo "skipped: no $needed"; exit 77; }
done
"$python" -c 'import h5py' 2>/dev/null || { echo "skipped: no h5py"; exit 77; }
[ -x "$program" ] || { echo "skipped: no $program"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# Octave draws no axes without FreeSans, which Debian only recommends beside it.
if [ ! -e /usr/share/fonts/opentype/freefont/FreeSans.otf ]; then
  font=$(fc-match --format '%{file}' 'DejaVu Sans') || { echo "skipped: no font"; exit 77; }
  mkdir fonts
  for style in '' Bold Oblique BoldOblique; do ln -s "$font" "fonts/FreeSans$style.otf"; done
  export OCTAVE_FONTS_DIR=$work/fonts
fi

run() { "$program" "$@" --quiet >>log 2>&1 || { cat log; exit 1; }; }
data=$root/data
run sweep "$data/phantom/layered.toml" -o layered.h5
run sweep "$data/phantom/wrapped.toml" -o wrapped.h5
run compare "$data/wismans-type/knee.toml" -o compare.h5
run laxity "$data/wismans-type/drawer.toml" -o laxity.h5
run simulate "$data/phantom/pendulum.toml" -o simulate.h5
run calibrate "$data/phantom/calibrate.toml" --starts 1 --samples 0 -o calibrate.h5
run study "$data/studies/phantom.toml" --samples 4 -o study.h5
"$python" "$here/odd_names.py" odd.h5

# What stands in for MATLAB's functions is in a folder of its own, and asks the same reader.
mkdir stand_in
cp "$here"/stand_in/*.m stand_in
cp "$root/tools/matlab/private/items_by_h5dump.m" stand_in/stand_in_items.m
sed -i 's/items_by_h5dump(/stand_in_items(/' stand_in/stand_in_items.m

octave-cli --no-init-file --quiet --path "$here" --eval "check_runs('$root/tools/matlab', 'stand_in')" >>log 2>&1 ||
  { cat log; exit 1; }
"$python" "$here/compare_with_h5py.py" ./*.told
for picture in sweep path laxity pressure; do
  [ "$(head -c 4 "$picture.png" | tail -c 3)" = PNG ] || { echo "no picture $picture.png"; cat log; exit 1; }
done
