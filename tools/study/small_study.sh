# shellcheck shell=bash
# Sourced by tests and measurements of studies.
comparison=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../tests/study/same_content.py")

# small_study KNEE.toml SAMPLES [WORDS]: a study file of one knee whose reference strains and stiffness vary.
small_study() {
  cat <<STUDY
title = "a knee whose strains and stiffnesses vary"
specimens = "$1"
design = "monte-carlo"
samples = $2
seed = 7
${3:-}
[[vary]]
what = "reference_strain"
of = "*"
sd = 0.02
[[vary]]
what = "stiffness"
of = "*"
sd = 0.1
STUDY
}

# same_content FILE...: nothing where all hold the same but for /provenance; otherwise what differs, and an end with 1.
same_content() {
  local status=0
  /usr/bin/python3 "$comparison" "$@" || status=$?
  [ "$status" -ne 77 ] || { echo "skipped: python3-h5py is missing" && exit 77; }
  return "$status"
}
