#!/usr/bin/env bash
# Sweeps knees that condyle was not tuned to (specimens beside the source, moved, turned, roughened), verifies every pose,
# and writes docs/strangers.md with each figure beside the one wanted, and the tables of docs/new.md: scenes that condyle new
# makes of their meshes. All of it takes about an hour on two cores; parts are known, steps, places, roughness, time, new.
# Ends with 2 where a figure is not met.
#
#   tools/strangers.sh [--quick] [--sweeps N] [--threads N] [--parts known,steps]
#
# --sweeps: of rough bone, 2000 where it is not given.
# --quick, and any choice of parts, write out/strangers.md in place of docs/strangers.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
TARGET=condyle build build -DCMAKE_BUILD_TYPE=Release >/dev/null
TARGET=condyle_strangers build build >/dev/null
page=docs/strangers.md
case " $* " in
  *" --quick "* | *" --parts"*) page=out/strangers.md ;;
esac
mkdir -p out
status=0
if [[ " $* " != *" --parts new "* ]]; then
  build/condyle_strangers build/condyle . -o "$page" "$@" || status=$?
  [ "$status" -eq 1 ] || echo "wrote $page" >&2
fi
if [[ " $* " != *" --parts "* || " $* " == *" --parts new "* ]]; then
  CONDYLE=$PWD/build/condyle tools/figures.sh --write docs/new.md
fi
exit "$status"
