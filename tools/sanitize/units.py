"""units.py COMPILE_COMMANDS FOLDER...: what is compiled of those folders, each once. A unit of several sources stands for
them where its first one is of such a folder."""
import json
import os
import re
import sys

folders = [os.path.abspath(folder) + os.sep for folder in sys.argv[2:]]
units = {}
for entry in json.load(open(sys.argv[1])):
    unit = entry["file"]
    sources = [unit]
    if "/Unity/" in unit:
        sources = re.findall(r'^#include "(.*)"', open(unit).read(), re.M)
    if any(source.startswith(folder) for source in sources[:1] for folder in folders):
        units[unit] = None
print("\n".join(units))
