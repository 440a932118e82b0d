#!/usr/bin/env bash
# Installs the mechanics into a scratch folder, builds the program beside this file against it, runs it, and sees what is
# linked. install_test.sh BUILD_FOLDER CXX [CXX_FLAG...]. Ends with 77 where the build has no such library.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1 cxx=$2
shift 2
if [ ! -f "$build/libcondyle_mechanics.a" ]; then
  echo "skipped: $build holds no libcondyle_mechanics.a"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --component mechanics --prefix "$work/installed" >"$work/log"

# No header that is installed asks for more than Eigen and the standard library, or for one that is not there.
cd "$work/installed/include"
grep -rhoE '#include [<"][^>"]*[>"]' condyle | sort -u | while read -r _ name; do
  case "$name" in
    '<Eigen/'*) ;;
    '<'*/*|'<'*.h'>'|'<'*.hpp'>') echo "an installed header includes $name" && exit 1 ;;
    '<'*) ;;
    *) [ -f "${name//\"/}" ] || { echo "an installed header includes $name, which is not installed" && exit 1; } ;;
  esac
done

cmake -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/installed" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_CXX_FLAGS="$*" >>"$work/log"
cmake --build "$work/build" >>"$work/log"
"$work/build/consumer"

# What the loader is asked for: the C and C++ runtimes (and what a sanitizer brings), nothing else.
needed=$(readelf -d "$work/build/consumer" | sed -nE 's/.*\(NEEDED\).*\[(.*)\]/\1/p')
echo "needs: $(tr '\n' ' ' <<<"$needed")"
if grep -vE '^(libstdc\+\+|libm|libgcc_s|libc|ld-linux.*|libasan|libubsan|libtsan)\.so' <<<"$needed"; then
  echo "the mechanics asks for more than the C and C++ runtimes"
  exit 1
fi
