#!/usr/bin/env bash
# Static analysis of src and tools: clang-tidy with the checks of .clang-tidy, and cppcheck. Any find ends it with 1; what is
# right as it stands says so in place (NOLINT, cppcheck-suppress) with the reason.
#
#     tools/analyse.sh [FOLDER...]      (src tools; src/condyle/results, say, is that room alone)
#
# Prints what was looked at and how long it took.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

build_packages+=(clang clang-tidy cppcheck)
install_packages
[ $# -gt 0 ] || set -- src tools
SECONDS=0

# What a room compiles at one go is parsed at one go here, too; its finds stand in the sources.
folder=build-analysis
CC=clang CXX=clang++ cmake -S . -B "$folder" -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
  -DCONDYLE_PRECOMPILED_HEADERS=OFF -DCONDYLE_VIEWER=OFF -DBUILD_TESTING=OFF >/dev/null
mapfile -t units < <(python3 tools/sanitize/units.py "$folder/compile_commands.json" "$@")
printf '%s\n' "${units[@]}" |
  xargs --max-procs="$(nproc)" --max-args=1 clang-tidy -p "$folder" --quiet 2> >(grep -vE '^[0-9]+ warnings? ' >&2)
printf 'clang-tidy %s: %s units of %s, nothing found, %s s\n' \
  "$(clang-tidy --version | sed -nE 's/.*version ([0-9.]+).*/\1/p')" "${#units[@]}" "$*" "$SECONDS"

SECONDS=0
# Two kinds that cppcheck 2.10 tells where there is nothing: an element of an array of `const char*` is an integer to it, and it
# does not know that what ends with a call of a [[noreturn]] member needs no return; the compiler tells both.
cppcheck --std=c++20 --language=c++ -I src -I tools -I tests -I "$folder/made" --enable=warning,portability --inline-suppr \
  --suppress=missingIncludeSystem --suppress=CastIntegerToAddressAtReturn --suppress=missingReturn \
  --quiet --error-exitcode=1 -j "$(nproc)" "$@"
printf '%s: %s files of %s, nothing found, %s s\n' \
  "$(cppcheck --version)" "$(find "$@" -name '*.cpp' | wc -l)" "$*" "$SECONDS"
