#!/usr/bin/env bash
# What elastic layers do to a knee, as rows of a table: the effect of E on the phantom, and layers beside rigid contacts.
# layers.sh modulus|shipped|specimens
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
scratch

# scene FILE LOAD E: its first load brought to LOAD N; E in N/mm² of layers of 3 mm with ν = 0.45, 0 for rigid contacts.
scene() {
  awk -v folder="$(cd "$(dirname "$1")" && pwd)" -v load="$2" -v E="$3" '
    /^\[/ { table = $0; if (table == "[[load]]") ++loads }
    /^(law = "layer"|modulus|poisson|layer) *=?/ && table != "[[ligament]]" { next }
    /^mesh = "[^\/]/ { sub(/"/, "\"" folder "/") }
    /^vector/ && table == "[[load]]" && loads == 1 {
      split($0, x, /[][,]/)
      factor = load / sqrt(x[2]^2 + x[3]^2 + x[4]^2)
      printf "vector = [%.9g, %.9g, %.9g]\n", factor * x[2], factor * x[3], factor * x[4]
      next
    }
    { print }
    E > 0 && /^compartment/ { printf "modulus = %g\npoisson = 0.45\nlayer = 3\n", E }
    E > 0 && /^surfaces/ { print "law = \"layer\"" }' "$1" >"$out/scene.toml"
}

# run NAME TO: sweeps the scene from 0 to TO by 5 and lays its poses down as $out/NAME.csv; an exit code of 2 is counted below.
run() {
  "$CONDYLE" sweep "$out/scene.toml" -o "$out/$1.h5" --from 0 --to "$2" --step 5 >/dev/null 2>&1 || [ $? -eq 2 ]
  "$CONDYLE" export "$out/$1.h5" -o "$out/$1.csv" >/dev/null 2>&1 || [ $? -eq 2 ]
}

# compare RIGID LAYERED FORM: differences of the poses that converge on both, printed by an awk expression that is told of
# rms["translation"], most["adduction"], of["medial force 60"] ...
compare() {
  awk -F, -v form="$3" '
    FNR == 1 { file++; next }
    { what = $5 " " $6; if ($4 == "joint") what = $6; at[file, $2, what] = $7; angle[$2] }
    $6 == "status" && $7 == 0 { poses[file]++; has[file, $2] = 1 }
    function off(a, what) { return at[2, a, what] - at[1, a, what] }
    function count(name, d) { if (d < 0) d = -d; square[name] += d * d; sum[name] += d; if (d > most[name]) most[name] = d }
    END {
      for (a in angle) if (has[1, a] && has[2, a]) {
        n++
        count("place", sqrt(off(a, "lateral_shift")^2 + off(a, "anterior_drawer")^2 + off(a, "distraction")^2))
        split("distraction anterior_drawer lateral_shift adduction internal_rotation", names, " ")
        for (k in names) count(names[k], off(a, names[k]))
        count("turn", sqrt(off(a, "adduction")^2 + off(a, "internal_rotation")^2))
        force = at[1, a, "medial force"] + at[1, a, "lateral force"]
        count("force", 100 * (off(a, "medial force") + off(a, "lateral force")) / force)
      }
      for (name in square) { rms[name] = sqrt(square[name] / n); mean[name] = sum[name] / n }
      if (form == "modulus") {
        printf "%d | %.2f mm | %.2f° | ", poses[2], rms["place"], rms["turn"]
        if (!has[2, 60]) { print "- | - | - | - | - | - |"; exit }
        printf "%.0f N | %.0f N | %.0f mm² | %.2f | %.2f N/mm² | %.3f mm |\n", at[2, 60, "medial force"],
          at[2, 60, "lateral force"], at[2, 60, "medial area"], at[2, 60, "medial pressure_mean"], at[2, 60, "medial pressure_max"], at[2, 60, "medial depth"]
      } else
        printf "%d | %d | %.2f / %.2f | %.2f | %.2f | %.2f | %.2f | %.0f / %.0f |\n", poses[1], poses[2], mean["distraction"],
          most["distraction"], most["anterior_drawer"], most["lateral_shift"], most["adduction"], most["internal_rotation"],
          mean["force"], most["force"]
    }' "$out/$1.csv" "$out/$2.csv"
}

phantom=data/phantom/layered.toml
if [ "$1" = modulus ]; then
  printf '| E [N/mm²] | poses of 19 | place | turn | medial force | lateral | medial area | mean | greatest pressure | depth |\n'
  printf '|---|---|---|---|---|---|---|---|---|---|\n'
  scene "$phantom" 80 0
  run rigid 90
  printf '| rigid | '
  compare rigid rigid modulus | sed -E 's/0 mm² .*/- | - | - | - |/'
  for E in 1 3 10 30 100 1000 10000 100000; do
    scene "$phantom" 80 "$E"
    run layered 90
    printf '| %s | ' "$(sed -E ':a; s/([0-9])([0-9]{3})($|,)/\1,\2\3/; ta' <<<"$E")"
    compare rigid layered modulus
  done
  exit
fi

# rows NAME FILE LOAD...
rows() {
  local name=$1 file=$2 load
  shift 2
  for load; do
    scene "$file" "$load" 0
    run rigid 120
    scene "$file" "$load" 10
    run layered 120
    printf '| %s | %s N | ' "$name" "$load"
    compare rigid layered knees
    name=
  done | sed 's/^|  |/| |/'
}
printf '| knee | load | rigid poses of 25 | layered | distraction mm, mean / max | drawer mm | lateral shift mm | adduction ° | internal rotation ° | forces %%, mean / max |\n'
printf '|---|---|---|---|---|---|---|---|---|---|\n'
if [ "$1" = shipped ]; then
  rows phantom "$phantom" 50 100 300 1000
else
  needs "$specimens"/{lenhart2015,clouthier2019_ssm}/knee.toml
  rows 'Lenhart 2015' "$specimens/lenhart2015/knee.toml" 50 100 300 1000
  rows 'Clouthier 2019' "$specimens/clouthier2019_ssm/knee.toml" 50 100 300 1000
fi
