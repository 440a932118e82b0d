#!/usr/bin/env bash
# Makes the samples of result files that have to stay readable (tests/app/old_results_test.cpp): one of each kind, of small
# knees, with what condyle export says of it, and journals as a kill leaves them.
#
#     tools/old_results.sh FOLDER
#
# What is kept in tests/results/format_0_1 is from the program of version 0.1.0 and is not made anew: a later format gets a folder of
# its own, made by this script with the first program that writes it.
#
# CONDYLE names the program, CONDYLE_PHANTOM the one that makes meshes; without them build/condyle and build/condyle_phantom.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
condyle=$(realpath "${CONDYLE:-build/condyle}") phantom=$(realpath "${CONDYLE_PHANTOM:-build/condyle_phantom}")
[ $# -eq 1 ] || { echo "usage: tools/old_results.sh FOLDER" >&2; exit 1; }
mkdir -p "$1"
kept=$(realpath "$1") data=$PWD/data
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# scene TITLE: a ball on a plate, four ligaments; the tables behind the scene from the standard input.
scene() {
  cat <<END
title = "kept: $1"
[units]
length = "mm"
angle = "deg"
force = "N"

[[body]]
name = "femur"
fixed = true

[[body]]
name = "tibia"
start.translation = [0, 0, 0]
start.rotation = [0, 0, 0]
mass = 4
center = [0, -100, 0]
inertia = [[20000, 0, 0], [0, 5000, 0], [0, 0, 20000]]

[joint]
side = "right"
femur = { body = "femur", origin = [0, 0, 0], lateral = [0, 0, 1], anterior = [1, 0, 0], proximal = [0, 1, 0] }
tibia = { body = "tibia", origin = [0, 0, 0], lateral = [0, 0, 1], anterior = [1, 0, 0], proximal = [0, 1, 0] }

[[surface]]
name = "ball"
body = "femur"
kind = "sphere"
center = [0, 20, 0]
radius = 20
modulus = 12
poisson = 0.45
layer = 3

[[surface]]
name = "plate"
body = "tibia"
kind = "plane"
point = [0, 0, 0]
normal = [0, 1, 0]
radius = 60
modulus = 12
poisson = 0.45
layer = 3

[[contact]]
name = "medial"
surfaces = ["ball", "plate"]

[[ligament]]
name = "aACL"
ends = [{ body = "femur", at = [-4, 22, 3] }, { body = "tibia", at = [3, -12, 0] }]
law = "toe-linear"
stiffness = 1500
slack_length = 31

[[ligament]]
name = "aPCL"
ends = [{ body = "femur", at = [4, 22, -3] }, { body = "tibia", at = [-3, -12, 0] }]
law = "toe-linear"
stiffness = 1500
slack_length = 31

[[ligament]]
name = "LCL"
ends = [{ body = "femur", at = [0, 25, 35] }, { body = "tibia", at = [0, -25, 30] }]
law = "toe-linear"
stiffness = 2000
reference_strain = 0.03

[[ligament]]
name = "aMCL"
ends = [{ body = "femur", at = [0, 25, -35] }, { body = "tibia", at = [5, -25, -30] }]
law = "toe-linear"
stiffness = 2000
reference_strain = 0.03

[[condition]]
name = "bend"
kind = "flexion"
value = 0

[[load]]
name = "weight"
body = "tibia"
kind = "force"
vector = [0, 100, 0]

[[load]]
name = "drawer"
body = "tibia"
kind = "force"
vector = [1, 0, 0]
scale = 0

END
  cat
}
flexion() { printf '[sweep]\nvary = "bend"\nfrom = 0\nto = %s\nstep = %s\n' "$1" "$2"; }
drawer='[sweep]
vary = "drawer.scale"
from = -20
to = 20
step = 20
'

{ flexion 20 10; echo 'sensitivities = ["aACL.reference_strain", "aPCL.stiffness"]'; } | scene sweep > sweep.toml
flexion 20 20 | scene "layer and wrap" | sed 's/^surfaces = .*/&\nlaw = "layer"\ntolerance = 0.05/; 0,/^slack_length/s/^slack_length.*/&\nwraps = ["post"]/
  s/^\[\[condition\]\]/[[wrap]]\nname = "post"\nbody = "femur"\nkind = "cylinder"\npoint = [0, 5, 0]\naxis = [0, 0, 1]\nradius = 6\n\n&/' > layer.toml
flexion 20 20 | scene compare | sed '0,/^center = \[0, 20, 0\]/s//center = [0, 20, -22]/
  s/^\[\[contact\]\]/[[surface]]\nname = "lateral ball"\nbody = "femur"\nkind = "sphere"\ncenter = [0, 20, 22]\nradius = 20\n\n[[contact]]\nname = "lateral"\nsurfaces = ["lateral ball", "plate"]\n\n&/' > compare.toml
{ echo "$drawer"; printf '[laxity]\nflexion = [0, 20]\ncut = ["aACL"]\n'; } | scene laxity > laxity.toml
printf '[simulate]\ntime = 0.04\nrate = 50\ngravity = [0, -9810, 0]\nflexion = 10\n' | scene simulate > simulate.toml
{ echo "$drawer"; cat <<'END'; } | scene calibrate > calibrate.toml
[calibrate]
measurements = "measured.csv"
starts = 1
samples = 10
[[calibrate.load]]
name = "anterior"
load = "drawer"
[[calibrate.parameter]]
of = ["aACL", "aPCL"]
what = "reference_strain"
prior_sd = 0.03
END
cat > measured.csv <<'END'
test,flexion,load,level,coordinate,value,sd,use
a,10,anterior,-20,anterior_drawer,-1,0.5,fit
a,10,anterior,20,anterior_drawer,1.5,0.5,fit
b,20,anterior,-20,anterior_drawer,-0.8,0.5,fit
b,20,anterior,20,anterior_drawer,1.2,0.5,test
END
cat > study.toml <<'END'
title = "kept: study"
specimens = ["sweep.toml"]
design = "saltelli"
samples = 20
outputs = ["joint.anterior_drawer", "aACL.force"]

[[vary]]
what = "reference_strain"
of = "aACL"
sd = 0.02

[[vary]]
what = "stiffness"
of = "*"
sd = 0.1
END

for kind in sweep layer; do "$condyle" sweep $kind.toml -o $kind.h5 --quiet; done
for kind in compare laxity simulate calibrate study; do "$condyle" $kind $kind.toml -o $kind.h5 --quiet; done
# Fitted patches, the bones' meshes, and mesh noise.
"$phantom" -o meshes --resolution 5 > /dev/null
mkdir -p data/phantom
cp "$data/phantom/knee.toml" data/phantom/
"$condyle" sweep data/phantom/knee.toml -o uncertainty.h5 --from 0 --to 20 --step 20 --uncertainty=2 --quiet
for kind in sweep layer compare simulate uncertainty; do "$condyle" export $kind.h5 -o $kind.csv > /dev/null; done

# killed FILE COUNT COMMAND...: the command is killed when that file has so many lines.
killed() {
  local file=$1 count=$2
  shift 2
  "$@" --quiet &
  while ! [ -f "$file" ] || [ "$(wc -l < "$file")" -lt "$count" ]; do sleep 0.001; done
  kill -KILL $!
  wait $! 2> /dev/null || true
}
flexion 20 0.001 | scene journal > journal.toml
killed journal.h5.journal 4 "$condyle" sweep journal.toml -o journal.h5
head -n 4 journal.h5.journal > journal

gzip -9 -n *.h5 *.csv
mv ./*.h5.gz ./*.csv.gz journal journal.toml "$kept"
rm "$kept/measured.csv.gz"
du -cb "$kept"/* | tail -n 1
