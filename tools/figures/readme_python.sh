#!/usr/bin/env bash
# What the Python lines of README.md print. Ends with 77 where the module is not built or no Python has NumPy.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tools/figures/program.sh
PYTHONPATH=$(dirname "$CONDYLE")/python
export PYTHONPATH
for python in python3 /usr/bin/python3; do
  "$python" -c 'import numpy, condyle' 2>/dev/null || continue
  sed -n '/^```python/,/^```/p' README.md | sed '/^```/d' | "$python" - | sed 's/^/    /'
  exit
done
exit 77
