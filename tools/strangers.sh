#!/usr/bin/env bash
# Sweeps knees that condyle was not tuned to (specimens beside the source, moved, turned, roughened), verifies every pose,
# and writes docs/strangers.md with each figure beside the one wanted. All of it takes about an hour on two cores; parts
# are known, steps, places, roughness, time. Ends with 2 where a figure is not met.
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
build/condyle_strangers build/condyle . -o "$page" "$@" || status=$?
[ "$status" -eq 1 ] || echo "wrote $page" >&2
exit "$status"
