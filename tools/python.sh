#!/usr/bin/env bash
# What Python adds to C++, measured in one process: the table of docs/python.md. Ends with 77 where there is no Python module
# to build. Half a minute.
#
#     tools/python.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/packages.sh
install_packages >&2
TARGET=condyle_python build build -DCMAKE_BUILD_TYPE=Release >/dev/null 2>&1 || exit 77
python=$(sed -n 's/^CONDYLE_PYTHON_EXECUTABLE:INTERNAL=//p' build/CMakeCache.txt)
PYTHONPATH=build/python exec "$python" tools/python/overheads.py
