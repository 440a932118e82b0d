#!/usr/bin/env bash
# A population of phantom knees, each swept: poses that converge, those that verify finds false, and how the knees differ, as
# a table of 5, 50 and 95 % of them.
#
#   tools/figures/population.sh [KNEES]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch
phantom=$(dirname "$CONDYLE")/condyle_phantom
[ -x "$phantom" ] || cmake --build "$(dirname "$CONDYLE")" --target condyle_phantom >/dev/null
"$phantom" --population "${1:-20}" --seed 1 --exact -o "$out" >/dev/null

false=0
for scene in "$out"/P*.toml; do
  knee=${scene%.toml}
  "$CONDYLE" sweep "$scene" -o "$knee.h5" >/dev/null 2>&1 || [ $? -eq 2 ]
  "$CONDYLE" verify "$knee.h5" >/dev/null 2>&1 || false=$((false + 1))
  "$CONDYLE" export "$knee.h5" -o "$knee.csv" >/dev/null 2>&1 || [ $? -eq 2 ]
done

awk -F, -v false="$false" '
  FNR == 1 { knees++; next }
  $6 == "status" { poses++; converged += $7 == 0 }
  $4 == "joint" { at[$6, $2, knees] = $7 }
  $4 == "contact" && $6 == "force" { at[$5, $2, knees] = $7 }
  $4 == "ligament" && $6 == "force" { group = substr($5, length($5) - 2); at[group, $2, knees] += $7 }
  # level q of what the knees have at a flexion, between the two nearest of them
  function quantile(q, n,   x, k) { x = 1 + q * (n - 1); k = int(x); return v[k] + (x - k) * (v[k + 1 > n ? n : k + 1] - v[k]) }
  function band(what, flexion, form,   i, j, n, x) {
    n = 0
    for (i = 1; i <= knees; ++i) if ((what, flexion, i) in at) {
      x = at[what, flexion, i]
      for (j = n++; j > 0 && v[j] > x; --j) v[j + 1] = v[j]
      v[j + 1] = x
    }
    return n == 0 ? "nan" : sprintf(form " / " form " / " form, quantile(0.05, n), quantile(0.5, n), quantile(0.95, n))
  }
  END {
    printf "%d knees: %d of %d poses converge; knees with a false one: %d\n\n", knees, converged, poses, false
    print "| flexion | internal rotation, ° | adduction, ° | anterior drawer, mm | medial contact, N | lateral contact, N | ACL, N | PCL, N | MCL, N |"
    print "|---|---|---|---|---|---|---|---|---|"
    for (flexion = 0; flexion <= 120; flexion += 30)
      printf "| %d° | %s | %s | %s | %s | %s | %s | %s | %s |\n", flexion, band("internal_rotation", flexion, "%.1f"),
        band("adduction", flexion, "%.1f"), band("anterior_drawer", flexion, "%.1f"), band("medial", flexion, "%.0f"),
        band("lateral", flexion, "%.0f"), band("ACL", flexion, "%.0f"), band("PCL", flexion, "%.0f"), band("MCL", flexion, "%.0f")
  }' "$out"/P*.csv
