#!/usr/bin/env bash
# Measures what a build costs (docs/architecture.md): everything that TARGET (condyle) needs, from an empty folder, without a
# compiler cache, and the compiler calls that cost most. Processor time, user and system, of the compilers alone; on a
# machine that does other things it is larger.
#
#   tools/build_cost.sh [TARGET] [CMAKE ARGUMENT...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages
install_where_possible time
target=${1:-condyle}
[ $# -eq 0 ] || shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export CCACHE_DISABLE=1
TARGET=$target build "$work/build" -DCMAKE_BUILD_TYPE=Release -DCONDYLE_VIEWER=OFF \
  "-DCMAKE_CXX_COMPILER_LAUNCHER=/usr/bin/time;-a;-o;$work/cost;-f;%U %S %C" "$@" >/dev/null
sort -k1,1 -rn "$work/cost" |
  awk '{ sum += $1 + $2; n = split($NF, path, "/")
         if (NR <= 20) printf "%6.1f s  %s/%s\n", $1 + $2, path[n - 1], path[n] }
       END { printf "%6.1f s  in %d calls\n", sum, NR }'
