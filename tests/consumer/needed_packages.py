"""needed_packages.py DEB...: installed packages without which these cannot be: what they depend on, what that depends on,
and what Debian calls essential. Ends with 1 and a line where something of it is not installed here."""

import re
import subprocess
import sys


def fields(text):
    """Fields of one paragraph of dpkg."""
    return dict(re.findall(r"^([\w-]+): (.*)", text, re.M))


def names(dependencies):
    """[[alternatives] ...] of "a (>= 1) | b, c"."""
    groups = [group.split("|") for group in dependencies.split(",") if group.strip()]
    return [[re.match(r"\s*([^\s(:]+)", one).group(1) for one in group] for group in groups]


with open("/var/lib/dpkg/status", encoding="utf-8") as file:
    paragraphs = [fields(text) for text in file.read().split("\n\n")]
installed = {p["Package"]: p for p in paragraphs if p.get("Status", "").endswith(" installed")}
provided = {}
for name, package in installed.items():
    for one in [name] + [group[0] for group in names(package.get("Provides", ""))]:
        provided.setdefault(one, []).append(name)

asked = [fields(subprocess.run(["dpkg-deb", "--field", deb], capture_output=True, text=True, check=True).stdout) for deb in sys.argv[1:]]
own = {package["Package"] for package in asked}
open_ones = asked + [p for p in installed.values() if p.get("Essential") == "yes"]
found = {p["Package"] for p in open_ones} - own
while open_ones:
    package = open_ones.pop()
    for group in names(package.get("Pre-Depends", "") + "," + package.get("Depends", "")):
        if own & set(group):
            continue
        choices = [name for one in group for name in provided.get(one, [])]
        if not choices:
            sys.exit(f"{package['Package']} depends on {' | '.join(group)}, which is not installed here")
        # The first that is there already, else the first.
        name = next((choice for choice in choices if choice in found), choices[0])
        if name not in found:
            found.add(name)
            open_ones.append(installed[name])
print("\n".join(sorted(found)))
