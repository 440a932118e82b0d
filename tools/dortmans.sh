#!/usr/bin/env bash
# Sweeps the problems of chapter 4 of Dortmans' report (data/dortmans) and sets iterations and times beside those that
# the report gives for its Prime P550. Results go into out/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/figures/program.sh

mkdir -p "$OUT"

# row SCENE ITERATIONS SECONDS: the last two columns of the program's table are iterations and microseconds.
row() {
  "$CONDYLE" sweep "data/dortmans/$1.toml" -o "$OUT/dortmans-$1.h5" |
    awk -v name="$1" -v iterations="$2" -v seconds="$3" '
      $NF == "us" { in_table = 1; next }
      !NF { in_table = 0 }
      in_table { all = all (n++ ? " " : "") $(NF - 1); time += $NF }
      END { printf "%-13s %9d  %-20s %8s %12.2f ms %8s\n", name, n, all, iterations, time / 1000, seconds }'
}

printf '%-13s %9s  %-20s %8s %15s %8s\n' problem positions iterations report 'time here' report
row problem1 4 '17 s'
row problem2 2 '12 s'
row problem3 3 '12 s'
row cancellation - -
