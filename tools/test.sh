#!/usr/bin/env bash
# Builds everything and runs all tests. --sanitize: with AddressSanitizer and UndefinedBehaviorSanitizer, in a build
# folder of its own. Further arguments go to ctest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

folder=build
options=(-DCMAKE_BUILD_TYPE=Release)
if [ "${1:-}" = --sanitize ]; then
  shift
  folder=build-sanitize
  options=(-DCMAKE_BUILD_TYPE=RelWithDebInfo -DCONDYLE_SANITIZE=ON)
fi

install_packages
install_npm_where_possible
install_where_possible chromium mandoc  # what tests look at reports and at the manual page with
build "$folder" "${options[@]}"
ctest --test-dir "$folder" --output-on-failure --parallel "$(nproc)" "$@"
