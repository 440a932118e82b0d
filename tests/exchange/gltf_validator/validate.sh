#!/usr/bin/env bash
# validate.sh FOLDER FILE.glb: fetches the validator into FOLDER once, and runs it. Exits with 77 where node or npm is
# missing or npm cannot reach its packages.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
folder=$1
command -v node >/dev/null && command -v npm >/dev/null || exit 77
mkdir -p "$folder"
(
  flock 9
  if [ ! -d "$folder/node_modules/gltf-validator" ]; then
    cp "$here/package.json" "$here/package-lock.json" "$folder"
    timeout 120 npm --prefix "$folder" ci --no-audit --no-fund >/dev/null 2>&1 || exit 77
  fi
) 9>"$folder/lock"
cp "$here/validate.js" "$folder"
node "$folder/validate.js" "$2"
