#!/usr/bin/env bash
# Installs the Python module of a build into a scratch folder and uses it from there; and looks through what describes the
# wheel. python_test.sh BUILD_FOLDER PYTHON. Ends with 77 where the build has no module.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$1 python=$2
compgen -G "$build/python/condyle/_condyle.*.so" >/dev/null || { echo "skipped: $build has no Python module"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$python" "$here/check_wheel.py" "$root" "$build"
cmake --install "$build" --component python --prefix "$work/installed" >"$work/log"
site=$(dirname "$(find "$work/installed/lib" -path '*/condyle/__init__.py' -printf '%h')")
case "$site" in
  "$work"/installed/lib/python3.*/*-packages) ;;
  *) echo "installed into $site" && exit 1 ;;
esac
cd "$work"
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$site "$python" - "$site" "$root" <<'PYTHON'
import sys

import condyle

assert condyle.__file__.startswith(sys.argv[1]), condyle.__file__
info = condyle.build_info()
assert info["version"] == condyle.__version__, info
assert info["made_by"] and info["build_type"] and info["compiler"] and info["libraries"]["HDF5"], info
run = condyle.sweep(condyle.read_scene(sys.argv[2] + "/data/phantom/knee.toml"))
assert run.converged.all()
print(condyle.__file__, info)
PYTHON
# Nothing of it leads back to the build.
if readelf -d "$site"/condyle/_condyle.*.so | grep -E 'R(UN)?PATH'; then
  echo "the module names a folder to look for libraries in"
  exit 1
fi
