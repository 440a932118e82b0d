#!/usr/bin/env bash
# What studies cost and whether they can be believed: tables of docs/study.md. On a machine that does nothing else.
#
#   tools/figures/study.sh speed|memory|bits|phantom
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
source tools/study/small_study.sh
build=$(dirname "$CONDYLE")
scratch
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# costs COMMAND...: seconds of the wall clock, seconds of processor time and MB at most that a command took.
costs() {
  python3 - "$@" <<'PYTHON'
import resource, subprocess, sys, time
begin = time.monotonic()
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
wall = time.monotonic() - begin
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"{wall:.3f} {used.ru_utime + used.ru_stime:.3f} {used.ru_maxrss / 1024:.0f}")
PYTHON
}

# fastest N COMMAND...: of N runs.
fastest() {
  local n=$1 k
  shift
  for ((k = 0; k < n; k++)); do costs "$@"; done | sort -n | head -1
}

# row NAME STUDY SAMPLES POSES: the whole command on one thread, on two, and on two ranks.
row() {
  local name=$1 file=$2 samples=$3 poses=$4 one two ranks=-
  one=$(fastest 2 "$CONDYLE" study "$file" --samples "$samples" -o "$out/one.h5" --threads 1)
  two=$(fastest 2 "$CONDYLE" study "$file" --samples "$samples" -o "$out/two.h5" --threads 2)
  if [ -x "$build/condyle-mpi" ] && command -v mpirun >/dev/null; then
    ranks=$(fastest 2 mpirun --oversubscribe --bind-to none -n 2 "$build/condyle-mpi" study "$file" --samples "$samples" \
      -o "$out/ranks.h5" --threads 1)
  fi
  awk -v name="$name" -v poses="$poses" -v one="$one" -v two="$two" -v ranks="$ranks" 'BEGIN {
    split(one, a); split(two, b)
    ratio = "-"
    if (split(ranks, c) > 1) ratio = sprintf("%.2f", b[1] / c[1])
    printf "| %s | %.2g | %.0f | %.0f | %.2f | %s |\n", name, poses, poses / a[2], poses / b[1], a[1] / (2 * b[1]), ratio
  }'
}

# A study of one knee by independent points of all its strains and stiffnesses.
of_springs() { small_study "$PWD/data/wismans-type/knee.toml" 1 'precision = "float32"'; }
of_phantom() { small_study "$PWD/data/phantom/knee.toml" 1 'precision = "float32"'; }

speed() {
  of_springs >"$out/springs.toml"
  of_phantom >"$out/phantom.toml"
  echo '| study | poses | poses/s and core, all included | poses/s on 2 threads | efficiency of 2 threads | 2 ranks over 2 threads |'
  echo '|---|---|---|---|---|---|'
  row "Wismans-type knee, 19 poses" "$out/springs.toml" 65536 $((65536 * 19))
  row "phantom, 25 poses" "$out/phantom.toml" 16384 $((16384 * 25))
}

memory() {
  of_springs | sed '1a outputs = ["joint.anterior_drawer"]' >"$out/springs.toml"
  echo '| samples | outputs kept [MB] | memory at most [MB] | processor time [s] | of it set-up [%] |'
  echo '|---|---|---|---|---|'
  local samples used one
  one=$(fastest 3 "$CONDYLE" study "$out/springs.toml" --samples 1 -o "$out/m.h5" --threads 1)
  for samples in 10000 100000 1000000; do
    used=$(costs "$CONDYLE" study "$out/springs.toml" --samples "$samples" -o "$out/m.h5")
    awk -v n="$samples" -v used="$used" -v one="$one" 'BEGIN {
      split(used, u); split(one, o)
      printf "| %d | %.0f | %.0f | %.0f | %.2f |\n", n, n * 19 * 4 / 1e6, u[3], u[2], 100 * o[2] / u[2] }'
  done
}

bits() {
  small_study "$PWD/data/wismans-type/knee.toml" 6000 >"$out/study.toml"
  "$CONDYLE" study "$out/study.toml" -o "$out/1.h5" --threads 1 --quiet
  local n
  for n in 2 3 7; do
    "$CONDYLE" study "$out/study.toml" -o "$out/n.h5" --threads "$n" --quiet
    same_content "$out/1.h5" "$out/n.h5"
    echo "    $n threads: the same bits as one"
  done
  for n in 3 1 2; do "$CONDYLE" study "$out/study.toml" -o "$out/p.h5" --part "$n/3" --quiet; done
  "$CONDYLE" study "$out/study.toml" -o "$out/p.h5" --merge --quiet
  same_content "$out/1.h5" "$out/p.h5"
  echo "    parts 3, 1 and 2 of 3, merged: the same bits"
  if [ -x "$build/condyle-mpi" ] && command -v mpirun >/dev/null; then
    for n in 1 2 3 7; do
      mpirun --oversubscribe --bind-to none -n "$n" "$build/condyle-mpi" study "$out/study.toml" -o "$out/r.h5" --quiet
      same_content "$out/1.h5" "$out/r.h5"
      echo "    $n ranks: the same bits"
    done
  fi
}

phantom() {
  "$CONDYLE" study data/studies/phantom.toml -o "$out/phantom.h5" | sed '/^wrote/d; s/^/    /; s/ *$//'
}

case "${1:-}" in
  speed | memory | bits | phantom) "$1" ;;
  *) echo "expected speed, memory, bits or phantom" >&2 && exit 1 ;;
esac
