#!/usr/bin/env bash
# A population of phantom knees. sweeps: each knee as it is, poses that converge, knees with one that verify finds false, and
# what the knees do, 5, 50 and 95 % of them. study: all of them with other reference strains, and how much of the spread is
# between knees and how much within one.
#
#   tools/figures/population.sh sweeps|study [KNEES]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch
phantom=$(dirname "$CONDYLE")/condyle_phantom
[ -x "$phantom" ] || cmake --build "$(dirname "$CONDYLE")" --target condyle_phantom >/dev/null
"$phantom" --population "${2:-20}" --seed 1 --exact -o "$out" >/dev/null

sweeps() {
  local false=0 scene knee
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
    $4 == "ligament" && $6 == "force" { at[substr($5, length($5) - 2), $2, knees] += $7 }
    # What a share q of the n sorted values v lies below.
    function quantile(q, n,   x, k) { x = 1 + q * (n - 1); k = int(x); return k < n ? v[k] + (x - k) * (v[k + 1] - v[k]) : v[n] }
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
}

study() {
  "$CONDYLE" study "$out/study.toml" -o "$out/study.h5" --bands "$out/bands.csv" >"$out/words.txt" 2>/dev/null || [ $? -eq 2 ]
  sed -nE 's/^([0-9]+ knees, [0-9]+ samples.*)$/\1;/p; s/^[0-9]+ poses, .*/&/p' "$out/words.txt"
  awk -F, '
    NR == 1 { next }
    $1 == "all" { band[$2, $4] = sprintf("%.3g / %.3g / %.3g", $9, $11, $13); unit[$2] = $3; next }
    $5 > 1 { n[$2, $4]++; sum[$2, $4] += $7; square[$2, $4] += $7 * $7; within[$2, $4] += $8 * $8 }
    END {
      print "\n| quantity | flexion | 5 / 50 / 95 % of all samples | sd between knees | sd within a knee |"
      print "|---|---|---|---|---|"
      count = split("internal_rotation adduction anterior_drawer medial.force lateral.force aACL.force aPCL.force", names, " ")
      for (i = 1; i <= count; ++i) for (flexion = 0; flexion <= 120; flexion += 60) {
        at = names[i] SUBSEP flexion
        m = sum[at] / n[at]
        printf "| %s, %s | %d° | %s | %.3g | %.3g |\n", names[i], unit[names[i]], flexion, band[at],
          sqrt((square[at] - n[at] * m * m) / (n[at] - 1)), sqrt(within[at] / n[at])
      }
    }' "$out/bands.csv"
}

"${1:?sweeps or study}"
