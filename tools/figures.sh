#!/usr/bin/env bash
# Makes figures of the documentation anew and says which are out of date. In a page
#
#     <!-- made by: COMMAND -->
#     a table or a block of code
#     <!-- end -->
#
# says that COMMAND, run by bash at the top of the project, prints what stands between. Words have to be the same, numbers as
# well, or within what "made within 5 % by:" allows; a number before µs, us, ms or s is a time and only has to be there. What takes long is "made when asked by:",
# that is where its page is named; the same with "made when asked within 5 % by:". A command that cannot run here (no specimens beside the project) ends with 77 and is passed over.
#
#     tools/figures.sh [--write] [--only WORD] [PAGE...]
#
# --write puts what the commands print into the pages, --only passes over commands without that word.
#
# CONDYLE names the program; without it the program is built. Ends with 1 where something is out of date.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/figures/program.sh

write=
if [ "${1:-}" = --write ]; then
  write=1
  shift
fi
only=
if [ "${1:-}" = --only ]; then
  only=$2
  shift 2
fi
asked=$#
[ $# -gt 0 ] || set -- README.md docs/*.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OUT=$work/out
stale=0 fresh=0 passed_over=0

# replace PAGE LINE FILE: the block below a line of a page becomes the file, indented as it was.
replace() {
  awk -v start="$2" -v file="$3" '
    NR == start { print; getline; if (/^$/) { print; getline }
      indent = /^    / ? "    " : ""
      while ((getline line < file) > 0) print line == "" ? "" : indent line
      while ($0 !~ /^<!-- end -->/) getline }
    { print }' "$1" >"$work/page"
  cat "$work/page" >"$1"
}

# check PAGE LINE MARKER: one block.
check() {
  local page=$1 line=$2 command within status=0
  if { [ "$asked" -eq 0 ] && [[ $3 == '<!-- made when asked '* ]]; } || [[ $3 != *"$only"* ]]; then
    passed_over=$((passed_over + 1))
    return
  fi
  command=$(sed -E 's/^<!-- made [^:]*by: (.*) -->$/\1/' <<<"$3")
  within=$(sed -nE 's/^<!-- made (when asked )?within ([0-9.]+) % by: .*/\2/p' <<<"$3")
  awk -v start="$line" 'NR > start && /^<!-- end -->/ { exit } NR > start' "$page" >"$work/old"
  bash -c "set -o pipefail; $command" >"$work/new" 2>"$work/err" || status=$?
  if [ "$status" -eq 77 ]; then
    passed_over=$((passed_over + 1))
  elif [ "$status" -ne 0 ] || grep -qw nan "$work/new"; then
    printf '%s:%s: %s: exit code %s%s\n' "$page" "$line" "$command" "$status" \
      "$(grep -w nan "$work/new" | sed 's/^/, no number in: /')"
    tail -3 "$work/err"
    stale=$((stale + 1))
  elif awk -v within="${within:-0}" -f tools/figures/compare.awk "$work/old" "$work/new" >"$work/what"; then
    fresh=$((fresh + 1))
  elif [ -n "$write" ]; then
    replace "$page" "$line" "$work/new"
    printf '%s:%s: written anew\n' "$page" "$line"
  else
    printf '%s:%s: out of date (%s)\n' "$page" "$line" "$command"
    cat "$work/what"
    stale=$((stale + 1))
  fi
}

for page in "$@"; do
  # From the last block to the first, so that writing one does not move those to come.
  while IFS=: read -r line marker; do
    check "$page" "$line" "$marker"
  done < <(grep -nE '^<!-- made .*by: ' "$page" | tac || true)
done
printf '%s blocks as the commands make them, %s out of date, %s not made here\n' "$fresh" "$stale" "$passed_over"
[ "$stale" -eq 0 ]
