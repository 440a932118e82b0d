#!/usr/bin/env bash
# Ends commands by signals at random moments (SIGKILL, and SIGINT and SIGTERM one time in five each), goes on with --resume, and
# compares every result that comes of it, dataset by dataset, with that of a run which nobody ended. Looks at what each signal leaves, too: no file under its final name that is not whole, and
# no temporary one but after SIGKILL. Prints a table; ends with 1 where something was wrong.
#
#   tools/kills.sh [N [COMMAND...]]        N signals for each command, 100 where it is not given
#
# CONDYLE names the program; without it the program is built. SEED (1) is that of the moments.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$PWD
source tools/figures/program.sh
source tools/faults/jobs.sh
CONDYLE=$(realpath "$CONDYLE")
STEP=0.5 COMPARED_STEP=0.02 MOTION_SECONDS=20
wanted=${1:-100}
[ $# -eq 0 ] || shift
commands=(sweep simulate laxity compare calibrate study)
[ $# -eq 0 ] || commands=("$@")
RANDOM=${SEED:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
make_inputs
threads=(1 2 3 7) wrong=0

milliseconds() { date +%s%3N; }

# fail WHAT: what went wrong first.
fail() {
  printf '%s: %s\n' "$command" "$1" >&2
  grep -v ': warning: ' said.log | tail -3 | cut -c 1-300 | sed 's/^/    /' >&2
  result=${result:-$1}
  wrong=1
}

# A resumed fit starts where the other stood: the same minimum to what its search stops at.
same_result() {
  if [ "$command" = calibrate ]; then
    /usr/bin/python3 "$top/tools/faults/same_fit.py" whole/result.h5 out/result.h5
  else
    local within=()
    [ "$command" != sweep ] || within=(--within 1e-9)
    same_content "${within[@]}" whole/result.h5 out/result.h5
  fi
}

# start RESUME...: the command in the background, as `process`.
start() {
  THREADS=${threads[$((runs % 4))]} job "$command" out
  stood_empty=$([ -e out/result.h5.journal ] && [ ! -s out/result.h5.journal ] && echo yes)
  env --default-signal=INT "$CONDYLE" "${words[@]}" "$@" --quiet >/dev/null 2>said.log &
  process=$!
  ((runs += 1))
}

# What a signal may leave.
look_at_remains() {
  local file
  shopt -s nullglob
  for file in out/*; do
    case $file in
      # One that SIGKILL left stays where the next run ends before it comes to take it.
      *.journal) [ -s "$file" ] || [ "$signal" = KILL ] || [ -n "$stood_empty" ] || fail "SIG$signal left $file, which holds nothing" ;;
      *.part"$process"????????????????) [ "$signal" = KILL ] || fail "SIG$signal left $file" ;;
      out/result.h5) [ -e out/result.h5.journal ] || same_result >compared.log 2>&1 || fail "SIG$signal left a result that is not whole" ;;
    esac
  done
  [ "$signal" = KILL ] || [ -z "$listening" ] || [ "$(grep -c '^condyle: ' said.log)" -ge 1 ] || fail "SIG$signal: not a word"
}

# Ended by itself: the result is the same, and nothing else is left.
look_at_result() {
  [ "$1" -eq "$usual" ] || fail "a run ended with $1"
  same_result >said.log 2>&1 || fail "$(tail -1 said.log)"
  [ -z "$(find out -mindepth 1 ! -name result.h5 ! -name fitted.toml)" ] || fail "left $(ls out | tr '\n' ' ')"
  ((results += 1))
  rm -rf out && mkdir out
}

kill_one() {
  local draw=$((RANDOM % 5)) status=0
  signal=KILL
  [ "$draw" -ne 3 ] || signal=INT
  [ "$draw" -ne 4 ] || signal=TERM
  start "${more[@]}"
  sleep "$(awk -v r="$RANDOM" -v w="$whole" 'BEGIN { print r / 32768 * w / 1000 }')"
  listening=$(listens "$process" && echo yes)
  if ! kill -"$signal" "$process" 2>/dev/null; then
    wait "$process" || status=$?
    look_at_result "$status"
    more=()
    return
  fi
  wait "$process" 2>/dev/null || status=$?
  if [ "$status" -eq "$usual" ] && [ -e out/result.h5 ] && [ ! -e out/result.h5.journal ]; then
    look_at_result "$status"  # the signal came when all was done
    more=()
    return
  fi
  ((killed[$signal] += 1, all += 1))
  look_at_remains
  more=(--resume)
}

echo "| command | SIGKILL | SIGINT | SIGTERM | results compared | |"
echo "|---|---|---|---|---|---|"
for command in "${commands[@]}"; do
  rm -rf out whole && mkdir out
  job "$command" out
  declare -A killed=([KILL]=0 [INT]=0 [TERM]=0)
  all=0 results=0 runs=0 result="" usual=0 more=()
  start
  wait "$process" || usual=$?
  rm -rf out whole.log && mkdir out
  begin=$(milliseconds)
  start
  wait "$process"
  whole=$(($(milliseconds) - begin))
  mv out whole && mkdir out
  while [ "$all" -lt "$wanted" ] && [ -z "$result" ]; do kill_one; done
  start "${more[@]}"
  status=0
  wait "$process" || status=$?
  look_at_result "$status"
  echo "| $command | ${killed[KILL]} | ${killed[INT]} | ${killed[TERM]} | $results | ${result:-as that of a run nobody ended} |"
done
exit "$wrong"
