#!/usr/bin/env bash
# look_at_report.sh CONDYLE SOURCE FOLDER: sweeps the phantom, writes its report and looks at it in Chromium without a
# head. Screenshots stay in FOLDER/seen. Exit code 77 where something that only this test needs is not there.
set -euo pipefail
condyle=$1 source=$2 folder=$3
here=$(dirname "${BASH_SOURCE[0]}")

skip() {
  echo "skipped: $*"
  exit 77
}
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || skip "there is no Chromium"
command -v node >/dev/null || skip "there is no node"
command -v npm >/dev/null || skip "there is no npm"

mkdir -p "$folder"
cp "$here"/package.json "$here"/package-lock.json "$here"/look_at_report.mjs "$folder"
cd "$folder"
npm ci --ignore-scripts --no-audit --no-fund --loglevel=error || skip "npm could not install what drives the browser"

"$condyle" sweep "$source/data/phantom/knee.toml" -o phantom.h5 --quiet
"$condyle" report phantom.h5 -o phantom.html --quiet
grep -q 'id="viewer-model"' phantom.html || skip "this condyle was built without the 3-D view"
node look_at_report.mjs "$chromium" phantom.html seen
