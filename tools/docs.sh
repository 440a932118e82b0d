#!/usr/bin/env bash
# Builds the pages of docs/ and README.md as a site into out/site, searchable without network, with a reference of the installed
# headers: mkdocs with its theme material, and doxygen. Ends with 1 where a link leads nowhere or a page would load
# anything from elsewhere, with 77 where these programs are not there.
#
#     tools/docs.sh [--pages] [FOLDER]        --pages: without the reference; FOLDER in place of out/site
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

reference=yes
if [ "${1:-}" = --pages ]; then reference=no && shift; fi
mkdir -p "${1:-out/site}"
site=$(cd "${1:-out/site}" && pwd)
[ "${CONDYLE_INSTALL:-yes}" = no ] || install_where_possible mkdocs-material doxygen
python=/usr/bin/python3  # Debian's, which has its mkdocs
if ! "$python" -c 'import mkdocs, pymdownx' 2>/dev/null || [ ! -d /usr/share/mkdocs/themes/material ]; then
  echo "no site: mkdocs with its theme material is not here (Debian: mkdocs-material)"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
module=$PWD/build/python  # by which notebooks get their figures
if [ "$reference" = no ] || ! PYTHONPATH=$module "$python" -c 'import condyle, ipykernel, matplotlib' 2>/dev/null; then module=; fi
"$python" tools/docs/gather_pages.py . "$work" "$site" ${module:+"$module"}
if [ "$reference" = no ]; then
  mkdir -p "$work/pages/reference"
  for page in index files annotated namespacemembers_func; do : >"$work/pages/reference/$page.html"; done
elif command -v doxygen >/dev/null; then
  rooms=$(sed -nE 's/^set\((mechanics|io|pictures)_rooms (.*)\)$/\2/p' CMakeLists.txt)
  {
    cat tools/docs/Doxyfile
    # shellcheck disable=SC2086  # rooms have no blanks in their names
    echo "INPUT = $(printf 'src/condyle/%s ' $rooms pictures) src/condyle/build_info.h src/condyle/input_error.h src/condyle/on_progress.h tools/docs/headers.md"
    echo "PROJECT_NUMBER = $(sed -nE 's/^project\(condyle VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)"
    echo "OUTPUT_DIRECTORY = $work/pages"
    echo "WARN_LOGFILE = $work/warnings"
  } >"$work/Doxyfile"
  doxygen "$work/Doxyfile"
  cat "$work/warnings" >&2
else
  echo "no site: doxygen is not here"
  exit 77
fi
"$python" -m mkdocs --quiet build --clean --config-file "$work/mkdocs.yml"
# For pages that are opened as files.
{ printf 'var searched_index = ' && cat "$site/search/search_index.json" && echo ';'; } >"$site/search/search_index.js"
"$python" tools/docs/check_site.py "$site"
echo "$site/index.html"
