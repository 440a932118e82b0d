#!/usr/bin/env bash
# The drawer tests of the shipped knees as a table: ours and (reference), mm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch

printf '| | 0° | 30° | 60° | 90° |\n|---|---|---|---|---|\n'
for knee in Wismans-type phantom; do
  # Exit code 2: some pose did not succeed, and its figure is nan.
  { "$CONDYLE" laxity "data/${knee,,}/drawer.toml" -o "$out/laxity.h5" 2>/dev/null || [ $? -eq 2 ]; } |
    awk -v knee="$knee" '
      $1 == "intact" || $1 == "cut" { row[$1] = row[$1] " " $3 " (" $4 ") |" }
      END { printf "| %s, intact |%s\n| %s, ACL cut |%s\n", knee, row["intact"], knee, row["cut"] }'
done
