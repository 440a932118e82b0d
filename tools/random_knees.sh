#!/usr/bin/env bash
# Sweeps made-up knees, sound ones and ill ones (tools/random), and prints the table of statuses of docs/reliability.md: each
# converged pose is judged by the code of condyle verify, every tenth sweep more closely. Ends with 2 where a converged
# pose is false or anything but bad input was thrown. What is wrong stands in out/random-knees.txt, a line each, first the
# number K of the knee: build/condyle_random_knees --only K writes it to out and says all about it.
#
#   tools/random_knees.sh [SWEEPS] [OPTION...]          options as of condyle_random_knees
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

install_packages >&2
TARGET=condyle_random_knees build build -DCMAKE_BUILD_TYPE=Release >/dev/null
mkdir -p out
sweeps=${1:-1000}
[ $# -eq 0 ] || shift
build/condyle_random_knees "$sweeps" --threads "$(nproc)" --wrong out/random-knees.txt "$@"
