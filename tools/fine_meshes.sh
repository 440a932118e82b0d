#!/usr/bin/env bash
# Measures what large mesh files cost (docs/mesh.md, Cost): the phantom's bones with each triangle cut into 64, read,
# cleaned and fitted. Meshes and runs go to out/fine.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
install_where_possible time
for target in condyle condyle_phantom; do TARGET=$target build build -DCMAKE_BUILD_TYPE=Release >/dev/null; done
mkdir -p out/fine
build/condyle_phantom -o out/fine --split 3
sed 's|"../../meshes/|"|' data/phantom/knee.toml >out/fine/knee.toml

# measure COMMAND...: what it costs
measure() {
  /usr/bin/time -o out/fine/cost -f '%U %S %M' "$@" >/dev/null
  awk -v command="${2}" '{ printf "condyle %s: %.1f s of processor time, %.0f MB\n", command, $1 + $2, $3 / 1024 }' out/fine/cost
}
measure build/condyle check out/fine/knee.toml
measure build/condyle fit out/fine/knee.toml -o out/fine/fit.h5
