#!/usr/bin/env bash
# Builds everything and runs all tests. --sanitize: with AddressSanitizer and UndefinedBehaviorSanitizer; --thread: those
# tests that start threads, with ThreadSanitizer; each in a build folder of its own. Further arguments go to ctest, or to
# the program of the latter.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

folder=build
options=(-DCMAKE_BUILD_TYPE=Release)
case "${1:-}" in
  --sanitize)
    folder=build-sanitize
    options+=(-DCONDYLE_SANITIZE=address)
    shift
    ;;
  --thread)
    shift
    install_packages
    TARGET=condyle_thread_tests build build-thread -DCMAKE_BUILD_TYPE=Release -DCONDYLE_SANITIZE=thread \
      -DCONDYLE_PICTURES=OFF -DCONDYLE_VIEWER=OFF
    build-thread/condyle_thread_tests --gtest_filter='SharedKnee.EightThreads*:FitSurfaces.FindsTheExactPhantom*:FitSurfaces.Names*:StudyChunks.*:StudyEffects.DoNotDependOnThreads:SampleDesign.APoint*:InParallel.*:PosteriorSamples.AreTheSameBits*' "$@"
    exit
    ;;
esac

install_packages
install_npm_where_possible
install_where_possible chromium mandoc  # what tests look at reports and at the manual page with
install_where_possible libopenmpi-dev openmpi-bin  # condyle-mpi
build "$folder" "${options[@]}"
ctest --test-dir "$folder" --output-on-failure --parallel "$(nproc)" "$@"
