#!/usr/bin/env bash
# What comes out of fits with automatic smoothing, as rows of a table: smoothing length, rms of the core, normals there, rms of
# the whole; medial and lateral condyle, medial and lateral plateau.   fits.sh phantom|specimens
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch

# row NAME SCENE DIGITS
row() {
  local folder
  folder=$(cd "$(dirname "$2")" && pwd)
  sed -E "s#^mesh = \"([^/][^\"]*)\"#mesh = \"$folder/\1\"#; /^fit = /d" "$2" >"$out/scene.toml"
  "$CONDYLE" fit "$out/scene.toml" -o "$out/fit.h5" 2>/dev/null | awk -v name="$1" -v digits="$3" '
    function short(x) { x = sprintf("%." digits "f", x); sub(/^0/, "", x); return x }
    /^known part/ { exit }
    $4 ~ /^[0-9]+x[0-9]+$/ || $3 ~ /^[0-9]+x[0-9]+$/ {
      k = ($1 ~ /lateral/ ? 2 : 1) + ($2 ~ /plateau/ ? 2 : 0)
      l[k] = sprintf("%.1f", $(NF - 9)); whole[k] = short($(NF - 8)); core[k] = short($(NF - 5))
      normals[k] = sprintf("%.1f", $(NF - 4))
    }
    function four(x) { return x[1] " " x[2] " " x[3] " " x[4] }
    END { printf "| %s | %s | %s | %s | %s |\n", name, four(l), four(core), four(normals), four(whole) }'
}

printf '| knee | ℓ mm | core rms mm | core normals deg | whole rms mm |\n|---|---|---|---|---|\n'
if [ "$1" = phantom ]; then
  row 'phantom, 0.2 mm roughness, l = 1.5' data/phantom/knee.toml 2
else
  needs "$specimens"/{lenhart2015,clouthier2019_ssm}/knee.toml "$specimens/oai_pymskt/femur_cartilage.ply"
  row 'Lenhart 2015, cartilage' "$specimens/lenhart2015/knee.toml" 3
  row 'Clouthier 2019, mean' "$specimens/clouthier2019_ssm/knee.toml" 3
  row 'OAI (pymskt), slabs of voxels' tests/data/oai_pymskt.toml 3
fi
