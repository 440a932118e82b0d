#!/usr/bin/env bash
# Sends what libFuzzer makes up through the doors of the program (tools/fuzz/doors.h), compiled by Clang with the sanitizers for
# addresses and undefined behaviour, and prints a row of a table for each: docs/reliability.md.
#
#   tools/fuzz.sh [DOOR [MINUTES]] [--runs N] [--rounds N]
#
# DOOR: a folder of tests/fuzz; all of them where none is named, or "all". MINUTES: for each door, 2. --runs ends a door after so many
# executions. A door begins with the files of its folder and of out/fuzz/DOOR, where what it learns is kept; with --rounds N it begins N
# times with the files of its folder alone, each for its part of the minutes: what it has learned may be slow. An input that crashes,
# leaks, takes more than 10 s or 2 GB is kept in out/fuzz, with the command that repeats it. Ends with 2 where there is one, with 77
# where there is no Clang with libFuzzer.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

runs=-1
rounds=0
words=()
while [ $# -gt 0 ]; do
  case $1 in
    --runs) runs=$2 && shift ;;
    --rounds) rounds=$2 && shift ;;
    *) words+=("$1") ;;
  esac
  shift
done
minutes=${words[1]:-2}

if ! command -v clang++ >/dev/null || [ -z "$(find "$(clang++ -print-resource-dir)" -name 'libclang_rt.fuzzer-*.a' -print -quit)" ]; then
  echo "tools/fuzz.sh needs clang++ with libFuzzer (Debian: clang libclang-rt-14-dev)" >&2
  exit 77
fi
build=build-fuzz
{
  CC=clang CXX=clang++ cmake -S . -B $build -DCMAKE_BUILD_TYPE=Release -DCONDYLE_SANITIZE=fuzz -DCONDYLE_VIEWER=OFF \
    -DCONDYLE_BENCHMARKS=OFF -DBUILD_TESTING=OFF -DCONDYLE_PRECOMPILED_HEADERS=OFF
  cmake --build $build --parallel "$(nproc)" --target condyle_fuzz
} >&2

kept=$PWD/out/fuzz
mkdir -p "$kept"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
export UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=$PWD/tools/fuzz/leaks.supp:print_suppressions=0
export ASAN_OPTIONS=malloc_context_size=4  # a deep stack for each allocation takes a tenth of the time
[ ! -d /dev/shm ] || export TMPDIR=/dev/shm

# last_or_0 PATTERN: what its group matches in the log's last such line.
last_or_0() {
  local found_in_log
  found_in_log=$(LC_ALL=C sed -nE "s/$1/\1/p" "$log" | tail -1)
  echo "${found_in_log:-0}"
}

larger() { echo $(($1 > $2 ? $1 : $2)); }

# one_run DOOR SECONDS RUNS: adds what it did to the numbers of the row. One that is interrupted is no find, and the last.
found=0 interrupted=0
one_run() {
  local door=$1 status=0 more=()
  mkdir -p "$kept/$door"
  [ "$door" != run ] || more=(tests/fuzz/whole_results)
  [ ! -f "tools/fuzz/$door.dict" ] || more+=("-dict=tools/fuzz/$door.dict")
  "$build/condyle_fuzz" "--door=$door" -timeout=10 -rss_limit_mb=2048 -detect_leaks=1 -entropic=0 -close_fd_mask=1 -print_funcs=0 \
    -print_final_stats=1 "-max_total_time=$(larger 1 "$2")" "-runs=$3" "-artifact_prefix=$kept/$door-" \
    "$kept/$door" "tests/fuzz/$door" "${more[@]}" >"$log" 2>&1 || status=$?
  if [ "$status" -eq 72 ]; then  # libFuzzer's, after SIGINT and SIGTERM
    interrupted=1
  elif [ "$status" -ne 0 ]; then
    finds=1 found=1
    grep -aE 'ERROR|what\(\)|SUMMARY' "$log" | head -3 >&2 || true
    sed -nE "s|.*Test unit written to (.*)|repeat: $build/condyle_fuzz --door=$door \1|p" "$log" >&2
  fi
  executions=$((executions + $(last_or_0 '^stat::number_of_executed_units: *([0-9]+)$')))
  memory=$(larger "$memory" "$(last_or_0 '^stat::peak_rss_mb: *([0-9]+)$')")
  edges=$(larger "$edges" "$(last_or_0 '^#[0-9].* cov: ([0-9]+).*')")
  corpus=$(larger "$corpus" "$(last_or_0 '^#[0-9].* corp: ([0-9]+).*')")
}

# fuzz DOOR: its row.
fuzz() {
  local door=$1 begin=$SECONDS round finds=0 executions=0 memory=0 edges=0 corpus=0
  if [ "$rounds" -eq 0 ]; then
    one_run "$door" $((60 * minutes)) "$runs"
  else
    for ((round = 0; round < rounds && finds == 0 && interrupted == 0 && (runs < 0 || executions < runs); ++round)); do
      rm -rf "${kept:?}/$door"
      one_run "$door" $((60 * minutes / rounds)) $((runs < 0 ? -1 : runs - executions))
    done
  fi
  printf '| %s | %s | %s | %s | %s | %s | %s |\n' "$door" "$executions" "$((SECONDS - begin))" "$memory" "$edges" "$corpus" "$finds"
}

printf '| door | executions | s | MB | edges | corpus | finds |\n|---|---|---|---|---|---|---|\n'
if [ "${words[0]:-all}" != all ]; then
  fuzz "${words[0]}"
else
  for folder in tests/fuzz/*/; do
    door=$(basename "$folder")
    [ "$door" = whole_results ] || [ "$interrupted" -eq 1 ] || fuzz "$door"
  done
fi
[ "$found" -eq 0 ] || exit 2
