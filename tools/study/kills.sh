#!/usr/bin/env bash
# Ends a study with kill -9 at N random moments, goes on with --resume on 1, 2, 3 or 7 threads, and compares every result
# that comes of it with that of one thread which nobody ended.
#
#   tools/study/kills.sh CONDYLE N [SAMPLES]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/small_study.sh"
condyle=$(realpath "$1") kills=$2 samples=${3:-6000}
knee=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../data/wismans-type/knee.toml")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
small_study "$knee" "$samples" >study.toml

milliseconds() { date +%s%3N; }
begin=$(milliseconds)
"$condyle" study study.toml -o whole.h5 --threads 1 --quiet
whole=$(($(milliseconds) - begin))

threads=(1 2 3 7)
killed=0 results=0 runs=0
resume=()
while [ "$killed" -lt "$kills" ]; do
  n=${threads[$((runs++ % 4))]}
  "$condyle" study study.toml -o killed.h5 --threads "$n" --quiet "${resume[@]}" &
  process=$!
  # On the average a third of the time that one thread takes for all.
  sleep "$(awk -v r="$RANDOM" -v w="$whole" 'BEGIN { print r / 32768 * w / 1500 }')"
  if kill -9 "$process" 2>/dev/null; then
    wait "$process" 2>/dev/null || true
    ((killed += 1))
    resume=(--resume)
    continue
  fi
  wait "$process" || { echo "a run ended with $?" && exit 1; }
  same_content whole.h5 killed.h5
  ((results += 1))
  rm -r killed.h5*
  resume=()
done
"$condyle" study study.toml -o killed.h5 --threads 2 --quiet "${resume[@]}"
same_content whole.h5 killed.h5
[ ! -e killed.h5.journal ] || { echo "the journals of a complete study are still there" && exit 1; }
echo "killed $killed times: $((results + 1)) results, all as that of one thread ($samples samples)"
