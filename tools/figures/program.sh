# shellcheck shell=bash
# Sourced: CONDYLE is the program to run, built where nobody names one; OUT the folder for what it writes; `specimens` is
# where others' knees are.
if [ -z "${CONDYLE:-}" ]; then
  source tools/packages.sh
  install_packages
  TARGET=condyle build build -DCMAKE_BUILD_TYPE=Release >/dev/null
  CONDYLE=$PWD/build/condyle
fi
export CONDYLE OUT=${OUT:-out}
specimens=../shared/specimens

# needs FILE...: ends the script with 77 where one is not there.
needs() {
  local file
  for file in "$@"; do [ -e "$file" ] || exit 77; done
}

# scratch: a folder of the script's own, gone when it ends.
scratch() {
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
}
