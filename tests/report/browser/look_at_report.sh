#!/usr/bin/env bash
# look_at_report.sh CONDYLE SOURCE FOLDER: sweeps the phantom, writes its report and a comparison of two runs, looks at both in
# Chromium without a head, and prints them. Screenshots stay in FOLDER/seen. Exit code 77 where something that only this
# test needs is not there.
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
cp "$here"/package.json "$here"/package-lock.json "$here"/*.mjs "$folder"
cd "$folder"
npm ci --ignore-scripts --no-audit --no-fund --loglevel=error || skip "npm could not install what drives the browser"

# One ligament has markup for a name.
sed -e "s|\.\./\.\./meshes|$source/meshes|" -e "s|^name = \"ALS\"|name = '<img src=x onerror=alert(3)>'|" "$source/data/phantom/knee.toml" >phantom.toml
"$condyle" sweep phantom.toml -o phantom.h5 --quiet
"$condyle" report phantom.h5 -o phantom.html --quiet
grep -q 'id="viewer-model"' phantom.html || skip "this condyle was built without the 3-D view"
node look_at_report.mjs "$chromium" phantom.html seen

# Two runs whose titles are markup, the second with another number and other poses.
hostile='</script></style><script>alert(1)</script><img src=x onerror=alert(2)>'
for run in first second; do
  sed -e "s|^title = .*|title = '$hostile'|" -e "s|\.\./\.\./meshes|$source/meshes|" "$source/data/phantom/knee.toml" >$run.toml
done
sed -i 's/^stiffness = 1500/stiffness = 2500/' second.toml
"$condyle" sweep first.toml -o first.h5 --quiet
"$condyle" sweep second.toml -o second.h5 --step 8 --quiet
"$condyle" report first.h5 second.h5 -o comparison.html --quiet
node look_at_comparison.mjs "$chromium" comparison.html "$hostile" seen

# On paper: every page has a text, its number and the number of all.
command -v pdftotext >/dev/null || { echo "not printed: there is no pdftotext" && exit 0; }
for page in phantom comparison; do
  "$chromium" --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --disable-dev-shm-usage \
    --no-pdf-header-footer --virtual-time-budget=5000 --print-to-pdf=$page.pdf "file://$PWD/$page.html" 2>/dev/null
  pages=$(pdfinfo $page.pdf | sed -n 's/^Pages: *//p')
  ((pages >= 3 && pages <= 20)) || { echo "$page.pdf has $pages pages" && exit 1; }
  for ((i = 1; i <= pages; ++i)); do
    text=$(pdftotext -f $i -l $i $page.pdf - | tr -d '[:space:]')
    [[ $text == *"$i/$pages"* ]] || { echo "page $i of $page.pdf has no number" && exit 1; }
    # More than its head, its number and a headline, or a picture.
    images=$(pdfimages -list -f $i -l $i $page.pdf | wc -l)
    ((${#text} > 60 || images > 2)) || { echo "page $i of $page.pdf is empty" && exit 1; }
  done
  echo "ok: $page.pdf has $pages pages, none of them empty"
done
