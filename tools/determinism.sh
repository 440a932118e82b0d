#!/usr/bin/env bash
# The same input in the program as it is built by other compilers, at other levels of optimisation, with and without fused
# multiply-add, on other numbers of threads: what of the results is the same to the last bit, and how far the rest is away.
#
#     tools/determinism.sh [CONFIGURATION...]
#
# Configurations are of this list, all of them where none is named. Those that are built take 6 to 8 minutes of a processor each.
#
#     threads    a study on 1, 3 and 8 threads, all else on one processor           same program
#     libm       the C library's mathematics without FMA (GLIBC_TUNABLES)           same program
#     o1         GCC -O1                                                            built
#     clang      Clang, which has no second body of hot functions for FMA (simd.h)  built
#     contract   GCC -mfma -ffp-contract=fast: all of it fused                      built
#
# CONDYLE names the program that is compared with, without it build/condyle. Builds stand in build-determinism-NAME and are
# kept. Ends with 77 where h5py is missing, with 1 where a quantity is further away than it may be
# (tools/determinism/compare.py).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
reference=$(realpath "${CONDYLE:-build/condyle}")
/usr/bin/python3 -c 'import h5py' 2> /dev/null || { echo "h5py is missing (python3-h5py)" >&2; exit 77; }
[ $# -gt 0 ] || set -- threads libm o1 clang contract
data=$PWD/data compare=$PWD/tools/determinism/compare.py
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# build NAME OPTION...: prints the program of that configuration, built of these sources.
build() {
  local folder=$PWD/build-determinism-$1
  shift
  mkdir -p "$folder"
  nice cmake -S . -B "$folder" -DCONDYLE_PICTURES=OFF -DCONDYLE_VIEWER=OFF -DCONDYLE_BENCHMARKS=OFF -DCONDYLE_MPI=OFF \
    -DBUILD_TESTING=OFF "$@" > "$folder/build.log" 2>&1 || { tail -n 5 "$folder/build.log" >&2; return 1; }
  nice cmake --build "$folder" --target condyle >> "$folder/build.log" 2>&1 || { tail -n 20 "$folder/build.log" >&2; return 1; }
  echo "$folder/condyle"
}

cat > "$work/study.toml" <<END
title = "determinism"
specimens = ["$data/wismans-type/knee.toml"]
design = "monte-carlo"
samples = 200

[[vary]]
what = "reference_strain"
of = "*"
sd = 0.02
END
{ cat "$data/wismans-type/drawer.toml"; cat <<'END'; } > "$work/calibrate.toml"

[calibrate]
measurements = "measured.csv"
starts = 4
samples = 200
[[calibrate.load]]
name = "anterior"
load = "drawer"
[[calibrate.parameter]]
of = ["aACL", "aPCL", "LCL"]
what = "reference_strain"
prior_sd = 0.03
END
cat > "$work/measured.csv" <<'END'
test,flexion,load,level,coordinate,value,sd,use
a,15,anterior,-100,anterior_drawer,-4,0.5,fit
a,15,anterior,100,anterior_drawer,5,0.5,fit
b,30,anterior,-100,anterior_drawer,-3,0.5,fit
b,30,anterior,100,anterior_drawer,6,0.5,fit
c,60,anterior,-100,anterior_drawer,-3,0.5,test
c,60,anterior,100,anterior_drawer,5,0.5,fit
END

# jobs PROGRAM FOLDER: the list of jobs.
jobs() {
  mkdir -p "$2"
  local sweep
  for sweep in wismans-type/knee phantom/knee phantom/layered phantom/wrapped; do
    "$1" sweep "$data/$sweep.toml" -o "$2/${sweep%/*}-${sweep#*/}.h5" --quiet || [ $? -eq 2 ]
  done
  "$1" laxity "$data/wismans-type/drawer.toml" -o "$2/laxity.h5" --quiet || [ $? -eq 2 ]
  "$1" simulate "$data/phantom/pendulum.toml" -o "$2/simulate.h5" --quiet || [ $? -eq 2 ]
  "$1" calibrate "$work/calibrate.toml" -o "$2/calibrate.h5" --quiet || [ $? -eq 2 ]
  "$1" sweep "$data/phantom/knee.toml" -o "$2/uncertainty.h5" --from 0 --to 60 --step 20 --uncertainty=4 --quiet || [ $? -eq 2 ]
  study "$1" "$2" 2
}
study() { "$1" study "$work/study.toml" -o "$2/study.h5" --threads "$3" --quiet || [ $? -eq 2 ]; }

printf '#!/bin/sh\nexec taskset -c 0 "%s" "$@"\n' "$reference" > "$work/one-processor"
chmod +x "$work/one-processor"
"$reference" --version
jobs "$reference" "$work/reference"
away=0
for name in "$@"; do
  case $name in
    threads)
      for threads in 3 8; do
        mkdir -p "$work/$threads"
        study "$reference" "$work/$threads" $threads
        /usr/bin/python3 "$compare" "$threads threads" "$work/reference" "$work/$threads" || away=1
      done
      jobs "$work/one-processor" "$work/$name" ;;
    libm) GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2 jobs "$reference" "$work/$name" ;;
    o1) built=$(build o1 -DCMAKE_CXX_FLAGS_RELEASE='-O1 -DNDEBUG'); jobs "$built" "$work/$name" ;;
    clang) built=$(build clang -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++); jobs "$built" "$work/$name" ;;
    contract) built=$(build contract -DCMAKE_CXX_FLAGS='-mfma -ffp-contract=fast'); jobs "$built" "$work/$name" ;;
    *) echo "unknown configuration $name, expected threads, libm, o1, clang, or contract" >&2; exit 1 ;;
  esac
  /usr/bin/python3 "$compare" "$name" "$work/reference" "$work/$name" || away=1
done
exit $away
