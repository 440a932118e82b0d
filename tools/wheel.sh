#!/usr/bin/env bash
# Builds a wheel of the Python module into out/ with scikit-build-core, and imports it from where pip puts it.
#
#     tools/wheel.sh [ARGUMENT OF PIP...]         --find-links FOLDER, --no-index, --index-url ...
#
# pip has to reach scikit-build-core, pybind11 and NumPy in an index or a folder of wheels (PIP_FIND_LINKS or --find-links);
# where it does not, that is said in a line and the script ends with 77. PYTHON names another Python than python3.
# The libraries behind condyle (HDF5, SUNDIALS, Ceres, ...) are not in the wheel: it is for machines that have them as this one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD
python=${PYTHON:-python3}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if ! "$python" -m pip --version >/dev/null 2>&1; then
  echo "no wheel: $python has no pip"
  exit 77
fi
mkdir "$work/tree"
if ! "$python" -m pip download --retries 0 --timeout 20 --no-deps --quiet --dest "$work/wheels" "$@" \
  'scikit-build-core>=0.10' 'pybind11>=2.10' 'numpy>=1.24' >"$work/log" 2>&1; then
  echo "no wheel: pip finds no scikit-build-core, pybind11 or numpy in an index or a folder of wheels (PIP_FIND_LINKS, --find-links)"
  exit 77
fi

source tools/packages.sh
install_packages
for name in CMakeLists.txt README.md data docs meshes src tests tools; do ln -s "$root/$name" "$work/tree/$name"; done
cp tools/packaging/wheel/pyproject.toml "$work/tree"
mkdir -p out
rm -f out/condyle-*.whl
"$python" -m pip wheel --no-deps --wheel-dir out "$@" "$work/tree"

"$python" -m pip install --quiet --no-deps --target "$work/site" out/condyle-*.whl
(cd "$work" && PYTHONPATH=$work/site "$python" -c '
import condyle
assert condyle.build_info()["made_by"] == "wheel", condyle.build_info()
print(condyle.__file__, condyle.build_info())')
ls out/condyle-*.whl
