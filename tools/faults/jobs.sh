# shellcheck shell=bash
# Sourced by tools/faults.sh and tools/kills.sh: a job of each command that writes something, of 0.1 to 2 s, and what is to be
# found where it wrote. `top` is the project, CONDYLE the program.
source "$top/tools/study/small_study.sh"
commands=(sweep simulate laxity compare calibrate study fit new export plot render report import)

# make_inputs: what the jobs read, in the current folder.
make_inputs() {
  local scene
  cp "$top"/meshes/{femur,tibia}.stl .
  for scene in knee pendulum drawer calibrate; do
    sed "s|\.\./\.\./meshes|$PWD|; s/^of = \"\*\"/of = \"aACL\"/; s|laxity.csv|$PWD/laxity.csv|" "$top/data/phantom/$scene.toml" >"$scene.toml"
  done
  grep -E "^(#|specimen|phantom,Markolf 1978)" "$top/data/phantom/laxity.csv" >laxity.csv
  sed "s/^time = 2/time = ${MOTION_SECONDS:-2}/" pendulum.toml >motion.toml
  cp "$top/data/wismans-type/knee.toml" wismans.toml
  small_study "$PWD/wismans.toml" "${SAMPLES:-1500}" >study.toml
  sed "s|\.\./\.\./meshes|$PWD|" "$top/tests/data/phantom_jam.osim" >model.osim
  "$CONDYLE" sweep knee.toml -o shown.h5 --step 10 --quiet
}

# job COMMAND OUT: `words` becomes the command that writes into the folder OUT, `output` the name that it writes.
job() {
  local out=$2
  output=$out/result.h5
  case $1 in
    sweep) words=(sweep "${SWEPT:-knee.toml}" -o "$output" --step "${STEP:-1}") ;;
    simulate) words=(simulate motion.toml -o "$output") ;;
    laxity) words=(laxity drawer.toml -o "$output") ;;
    compare) words=(compare wismans.toml -o "$output" --step "${COMPARED_STEP:-0.5}") ;;
    calibrate) words=(calibrate calibrate.toml -o "$output" --scene "$out/fitted.toml" --samples 20 --starts 1) ;;
    study) words=(study study.toml -o "$output" --threads "${THREADS:-2}") ;;
    fit) words=(fit knee.toml -o "$output") ;;
    new)
      output=$out/new.toml
      words=(new femur.stl tibia.stl -o "$output")
      ;;
    export)
      output=$out/files
      words=(export shown.h5 -o "$output" --format glb,vtk,csv,stl,opensim)
      ;;
    plot)
      output=$out/plots
      words=(plot shown.h5 -o "$output" --format svg)
      ;;
    render)
      output=$out/pictures
      words=(render shown.h5 -o "$output" --at 30)
      ;;
    report)
      output=$out/report.html
      words=(report shown.h5 -o "$output")
      ;;
    import)
      output=$out/scene.toml
      words=(import model.osim -o "$output")
      ;;
  esac
}

# listens PROCESS: it is beyond its loader, and answers a signal.
listens() { grep -q '^SigCgt:.*[2367abef]$' "/proc/$1/status" 2>/dev/null; }

# files_in FOLDER: names of files and journals, without what is inside journals.
files_in() { (cd "$1" && find . -name '*.journal' -prune -print -o -type f -print | sort); }

# is_readable FILE: a result makes a page, a scene is checked.
is_readable() {
  if [[ $1 == *.h5 ]]; then
    "$CONDYLE" report "$1" -o page.html --no-pictures --no-viewer >/dev/null 2>&1 && rm -f page.html
  else
    "$CONDYLE" check "$1" >/dev/null 2>&1
  fi
}

# what_is_wrong WHOLE OUT: a word about the first file of OUT that WHOLE does not have, or that is not as it is there; of a
# calibration that says that it holds the best so far, that cannot be read.
what_is_wrong() {
  local file
  while read -r file; do
    [[ $file != *.journal ]] || continue
    [ -e "$1/$file" ] || { echo "left $file" && return; }
    if grep -q 'holds the best so far' said.log 2>/dev/null; then
      is_readable "$2/$file" || { echo "$file cannot be read" && return; }
    elif [[ $file == *.h5 ]]; then
      same_content --within 1e-9 "$1/$file" "$2/$file" >differs.log 2>&1 || { echo "$file is not whole" && return; }
    else
      cmp -s "$1/$file" "$2/$file" || { echo "$file is not whole" && return; }
    fi
  done < <(files_in "$2")
}
