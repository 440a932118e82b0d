#!/usr/bin/env bash
# Builds everything and runs all tests, then those that tell most under sanitizers for their time.
#
#     tools/test.sh [--plain | --sanitize | --selection | --thread | --valgrind] [ARGUMENT...]
#
# --plain: all tests and no sanitizers, as well where arguments are given. --sanitize: all tests with AddressSanitizer (and
# what is never freed) and UndefinedBehaviorSanitizer; --selection: those of them that end an ordinary run. --thread: the
# tests that start threads, with ThreadSanitizer. --valgrind: a sweep under memcheck. The sanitizers are Clang's where it is
# there, in build folders of their own. Arguments go to ctest, those of --selection and --thread to the programs of tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh

way=all
case "${1:-}" in
  --plain | --sanitize | --selection | --thread | --valgrind)
    way=${1#--}
    shift
    ;;
  ?*) way=plain ;;
esac

# Rooms through which bytes of strangers come (condyle_selected_tests), without the tests that start condyle itself.
selection=(results scene mesh exchange)
starting_condyle='Exchange.*:LaxityTables.AsAUserMakesThem'

export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
export ASAN_OPTIONS=${ASAN_OPTIONS:-strict_string_checks=1:detect_stack_use_after_return=1}
export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$PWD/tools/sanitize/leaks.supp:print_suppressions=0}
export TSAN_OPTIONS=${TSAN_OPTIONS:-halt_on_error=1}

# As condyle itself keeps memory (program.cpp).
export MALLOC_MMAP_THRESHOLD_=$((32 << 20)) MALLOC_TRIM_THRESHOLD_=$((256 << 20))

sanitizer_packages=(clang libclang-rt-14-dev)

# sanitized FOLDER SANITIZER [CMAKE ARGUMENT...]: Clang's cost a fifth of GCC's. What is measured or bundled is no part.
sanitized() {
  local folder=$1 sanitizer=$2
  shift 2
  SECONDS=0
  install_where_possible "${sanitizer_packages[@]}"
  if command -v clang++ >/dev/null; then export CC=clang CXX=clang++; fi
  build "$folder" -DCMAKE_BUILD_TYPE=Release -DCONDYLE_SANITIZE="$sanitizer" -DCONDYLE_BENCHMARKS=OFF -DCONDYLE_VIEWER=OFF "$@"
  built=$SECONDS
}

# run_tests FOLDER [ARGUMENT...]
run_tests() {
  local folder=$1
  shift
  # One more than processors: some tests wait for clocks.
  ctest --test-dir "$folder" --output-on-failure --parallel "$(($(nproc) + 1))" "$@"
}

# told SANITIZERS: the line of docs/reliability.md.
told() {
  printf '%s: built in %s s, run in %s s, on %s cores\n' "$1" "$built" "$((SECONDS - built))" "$(nproc)"
}

install_packages
case "$way" in
  all | plain)
    install_npm_where_possible
    install_where_possible libopenmpi-dev openmpi-bin  # condyle-mpi
    # What tests look at reports and at the manual page with, and the sanitizers, come while the build goes on.
    looks=(chromium mandoc)
    [ "$way" = plain ] || looks+=("${sanitizer_packages[@]}")
    install_where_possible "${looks[@]}" &
    build build -DCMAKE_BUILD_TYPE=Release
    wait
    run_tests build "$@"
    ;;&
  all | selection)
    TARGET=condyle_selected_tests sanitized build-selection address -DCONDYLE_PICTURES=OFF -DCONDYLE_COMPILE_SOON=ON
    # Each program at one go: to start a sanitized process takes longer than most tests.
    printf '%s\n' "${selection[@]}" | xargs -P "$(nproc)" -I ROOM timeout 900 \
      build-selection/condyle_ROOM_tests --gtest_brief=1 "--gtest_filter=-$starting_condyle" "$@"
    told "AddressSanitizer and UndefinedBehaviorSanitizer, rooms ${selection[*]}"
    ;;
  sanitize)
    sanitized build-sanitize address -DCONDYLE_PICTURES=ON
    run_tests build-sanitize "$@"
    told "AddressSanitizer and UndefinedBehaviorSanitizer, all tests"
    ;;
  thread)
    TARGET=condyle_thread_tests sanitized build-thread thread -DCONDYLE_PICTURES=OFF
    # A test of threads says so in its name; beside those, what starts some by itself.
    build-thread/condyle_thread_tests \
      --gtest_filter='*Thread*:InParallel.*:StudyChunks.*:MultiStart.*:Profiles.*:FitSurfaces.FindsTheExactPhantom*:FitSurfaces.Names*' "$@"
    told "ThreadSanitizer, tests that start threads"
    ;;
  valgrind)
    exec tools/sanitize/memcheck.sh
    ;;
esac
