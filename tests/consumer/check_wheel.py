"""check_wheel.py ROOT BUILD: what pyproject.toml says of the wheel is true of the project, as far as it is seen without the
program that builds wheels: the version, the options of CMake, the target, the component, and that module and Python agree."""

import pathlib
import re
import sys
import tomllib

root, build = map(pathlib.Path, sys.argv[1:])
described = tomllib.loads((root / "tools/packaging/wheel/pyproject.toml").read_text(encoding="utf-8"))
project, settings = described["project"], described["tool"]["scikit-build"]

assert re.fullmatch(r"[a-z]+", project["name"]) and project["dynamic"] == ["version"] and "version" not in project
assert (root / project["readme"]).is_file()
assert described["build-system"]["build-backend"] == "scikit_build_core.build"

version = settings["metadata"]["version"]
found = re.search(version["regex"], (root / version["input"]).read_text(encoding="utf-8"))
cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
assert found and f"CMAKE_PROJECT_VERSION:STATIC={found['value']}\n" in cache, found

known = set(re.findall(r"^(\w+):\w+=", cache, re.M))
assert set(settings["cmake"]["define"]) <= known, set(settings["cmake"]["define"]) - known
assert settings["build"]["targets"] == ["condyle_python"]
packaging = (root / "tools/packaging/CMakeLists.txt").read_text(encoding="utf-8")
for component in settings["install"]["components"]:
    assert re.search(rf"COMPONENT {component}\b", packaging), component
minimum = tuple(map(int, re.fullmatch(r">=(\d+)\.(\d+)", project["requires-python"]).groups()))
assert sys.version_info >= minimum
print(f"the wheel would be {project['name']} {found['value']}")
