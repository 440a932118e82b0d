#!/usr/bin/env bash
# Measures what the parts of a study on a cluster cost on this machine, and prints that with what 1,000 cores and 1e9 poses
# would need, as tables in Markdown (docs/study.md). Ends with 77 where there is no MPI.
#
#   tools/study/cluster_costs.sh [STUDY.toml]
set -euo pipefail
study=$(realpath "${1:-.}")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
source tools/study/small_study.sh
build=$(dirname "$CONDYLE")
if [ ! -x "$build/condyle-mpi" ] || ! command -v mpirun >/dev/null; then echo "skipped: no MPI" >&2 && exit 77; fi
cmake --build "$build" --target condyle_cluster_costs >/dev/null
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
small_study "$PWD/data/wismans-type/knee.toml" 20000 >"$work/study.toml"
[ -f "$study" ] || study=$work/study.toml
two_ranks=(mpirun --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -n 2)
tcp=$("${two_ranks[@]}" --mca osc pt2pt --mca btl tcp,self "$build/condyle_cluster_costs" counter)
"${two_ranks[@]}" "$build/condyle_cluster_costs" "$study" "$work" "$tcp"
