#!/usr/bin/env bash
# Puts faults in the way of every command that writes something, and looks at what is left: nothing half-written under its
# final name, no temporary file, one line that says what happened, an exit code as documented, no end by a signal that nobody
# sent and none after more than a minute. Prints a table of cases and commands, "ok" and how often, or what went wrong, and
# ends with 1 where something did.
#
#   tools/faults.sh [--quick] [CASE...]       cases are the functions of tools/faults/cases.sh
#
# CONDYLE names the program; without it the program is built.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
top=$PWD
source tools/figures/program.sh
source tools/faults/jobs.sh
source tools/faults/cases.sh
CONDYLE=$(realpath "$CONDYLE")
cases=(full_disk read_only_folder quota memory closed_streams full_streams strange_outputs two_runs clock_goes_back changing_files signals)
if [ "${1:-}" = --quick ]; then
  shift
  disks=(0 16) memories=(80000 110000) commands=(sweep study export import)
  cases=(full_disk read_only_folder quota memory closed_streams full_streams strange_outputs two_runs signals)
  SAMPLES=300 SWEPT=wismans.toml STEP=0.1  # no meshes, to which the patches of the other are fitted each time
fi
[ $# -eq 0 ] || cases=("$@")

work=$(mktemp -d)
chmod 755 "$work"
trap 'umount "$work/out" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work"
make_inputs
prefix=() wrong=0

takes_folder() { [[ " export plot render " == *" $1 "* ]]; }
reads_mesh() { [[ " sweep simulate laxity calibrate fit new " == *" $1 "* ]]; }
input_of() { case $1 in new) echo femur.stl ;; import) echo model.osim ;; *) echo shown.h5 ;; esac; }

can_mount() { [ "$(id -u)" -eq 0 ] && mkdir -p mounted && mount -t tmpfs none mounted 2>/dev/null && umount mounted; }

# relocate PATH: the command writes there.
relocate() {
  local i
  for i in "${!words[@]}"; do words[i]=${words[i]/#$output/$1}; done
  output=$1
}

# begin COMMAND: an empty folder `out`, and the words of the command.
begin() {
  rm -rf out
  mkdir out
  chmod 777 out
  job "$1" out
  code=0 prefix=() says=line
}

run_job() { timeout 60 "${prefix[@]}" "$CONDYLE" "${words[@]}"; }
try() { run_job >said.out 2>said.log || code=$?; }

skip() {
  result="skipped: $1"
  exit_case=1
}

# fail WHERE WHAT: what went wrong first of this case and command.
fail() {
  printf '%s, %s, %s: %s\n' "$case_name" "$command" "$1" "$2" >&2
  grep -v ': warning: ' said.log 2>/dev/null | tail -3 | cut -c 1-300 | sed 's/^/    /' >&2
  [ -n "$result" ] || result="$1: $2"
}

# meet WHERE CODE...: what is left after a fault, and whether it ended as it may.
meet() {
  local where=$1 found lines
  shift
  ((times += 1))
  [[ " $* " == *" $code "* ]] || { fail "$where" "exit code $code" && return; }
  found=$(what_is_wrong "whole/$command" out)
  [ -z "$found" ] || fail "$where" "$found"
  [ -n "$says" ] || return 0
  lines=$(grep '^condyle: ' said.log | grep -vc '^condyle: warning: ')
  if [ "$code" -eq 1 ] || [ "$code" -gt 128 ]; then
    [ "$lines" -eq 1 ] || fail "$where" "$lines lines"
  fi
  grep -q 'terminate called\|AddressSanitizer\|runtime error' said.log && fail "$where" "$(grep -m1 'terminate\|Sanitizer\|runtime' said.log)"
  return 0
}

# An output that cannot be is refused: nothing is written, and nothing that stood there is gone.
meet_refusal() {
  ((times += 1))
  [ "$code" -eq 1 ] || fail "$1" "exit code $code"
  [ "$(ls -R out)" = "$before" ] || fail "$1" "what stood there has changed"
  [ "$(grep -c '^condyle: ' said.log)" -eq 1 ] || fail "$1" "not one line"
}

# What the command writes is all there.
is_whole() {
  local missing
  missing=$(comm -23 <(files_in "whole/$command") <(files_in out) | head -1)
  [ -z "$missing" ] || fail "whole" "$missing is missing"
}

# The jobs as they are without a fault; whole_seconds of each.
declare -A seconds
for command in "${commands[@]}"; do
  begin "$command"
  start=$(date +%s%3N)
  try
  seconds[$command]=$(awk -v ms=$(($(date +%s%3N) - start)) 'BEGIN { print ms / 1000 }')
  [ "$code" -eq 0 ] || [ "$code" -eq 2 ] || { echo "$command: exit code $code" && cat said.log && exit 1; }
  mkdir -p whole
  mv out "whole/$command"
done

echo "| case | $(printf '%s | ' "${commands[@]}")"
printf '|---%.0s' "" "${commands[@]}"
echo "|"
for case_name in "${cases[@]}"; do
  row="| ${case_name//_/ } |"
  for command in "${commands[@]}"; do
    result="" times=0 exit_case="" whole_seconds=${seconds[$command]}
    "$case_name" "$command"
    if [ -n "$result" ] && [ -z "$exit_case" ]; then wrong=1; fi
    row+=" ${result:-ok $times} |"
  done
  echo "$row"
done
exit "$wrong"
