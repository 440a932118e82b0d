"""gather_pages.py ROOT FOLDER SITE [MODULE]: lays out what mkdocs reads: the pages of docs, README.md as index.md, the files of
the project that pages link to, notebooks as pages where nbconvert is there, with their figures where MODULE is a folder with
the Python module that they import, and mkdocs.yml with its folders."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT, FOLDER, SITE = (pathlib.Path(name).resolve() for name in sys.argv[1:4])
MODULE = sys.argv[4] if len(sys.argv) > 4 else None
PAGES = FOLDER / "pages"
LINK = re.compile(r"\]\(([^)#\s]+)(#[^)\s]*)?\)")
UPWARDS = re.compile(r"\]\((\.\./[^)#\s]+)(#[^)\s]*)?\)")

# Makes pages of notebooks; without it they go along as files.
CONVERTER = [sys.executable, "-m", "nbconvert"]
if subprocess.run([*CONVERTER, "--version"], capture_output=True, check=False).returncode != 0:
    CONVERTER = None


def linked(match, place, up=""):
    """A link as it is on the site; place: folder of the project that it was written in; up: from its page to the first ones."""
    target, anchor = match.group(1), match.group(2) or ""
    if re.match(r"[a-z]+:", target):
        return match.group(0)
    file = pathlib.Path(os.path.normpath(place / target))
    if file == ROOT / "README.md":
        return f"]({up}index.md{anchor})"
    if file.suffix == ".ipynb" and CONVERTER:
        file = file.with_suffix(".md")
    if file.is_relative_to(ROOT / "docs") and file.suffix != ".ipynb":
        return f"]({up}{file.relative_to(ROOT / 'docs')}{anchor})"
    if not file.is_file():
        sys.exit(f"{place}: a link to {target}, expected a file that is there")
    # Sources and data go along as plain text.
    name = f"files/{file.relative_to(ROOT)}" + ("" if file.suffix == ".ipynb" else ".txt")
    copy = PAGES / name
    copy.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(file, copy)
    return f"]({up}{name})"


def indented(text):
    """The page with lists as Python-Markdown wants them: what is in an item is indented by 4, and a list begins after a blank
    line. As they are written, for other readers, it is what stands below the first letter of the item."""
    in_list = False
    lines, inside, fenced, blank = [], [], False, True  # inside: where the text of each open item begins
    for line in text.split("\n"):
        indent = len(line) - len(line.lstrip(" "))
        if line.lstrip().startswith("```"):
            fenced = not fenced
        if not line.strip() or (fenced and not inside):
            lines.append(line)
            blank = not line.strip()
            continue
        while inside and indent < inside[-1]:
            inside.pop()
        base = inside[-1] if inside else 0
        new = " " * (4 * len(inside) + indent - base)
        marker = re.match(r"([-*]|\d+\.) +", line[indent:])
        if marker and indent - base < 4 and not fenced:
            if not blank and not in_list:
                lines.append("")
            inside.append(indent + marker.end())
        in_list = bool(inside)
        lines.append(new + line[indent:])
        blank = False
    return "\n".join(lines)


def lay_out(source, name):
    text = indented(source.read_text(encoding="utf-8"))
    (PAGES / name).write_text(LINK.sub(lambda match: linked(match, source.parent), text), encoding="utf-8")


def lay_out_notebooks():
    """Lines of the navigation."""
    notebooks = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))
    if not notebooks or not CONVERTER:
        return []
    execute = ["--execute"] if MODULE else []
    subprocess.run([*CONVERTER, *execute, "--to", "markdown", "--log-level", "ERROR", "--output-dir", PAGES / "notebooks", *notebooks],
                   check=True, env={**os.environ, **({"PYTHONPATH": MODULE, "PYDEVD_DISABLE_FILE_VALIDATION": "1"} if MODULE else {})})
    lines = []
    for notebook in notebooks:
        page = PAGES / "notebooks" / f"{notebook.stem}.md"
        text = page.read_text(encoding="utf-8")
        title = re.search(r"^# (.+)", text, re.M)
        page.write_text(UPWARDS.sub(lambda match: linked(match, ROOT / "docs" / "notebooks", "../"), text), encoding="utf-8")
        lines.append(f"- \"{title.group(1) if title else notebook.stem}\": notebooks/{notebook.stem}.md")
    return lines


PAGES.mkdir(parents=True)
lay_out(ROOT / "README.md", "index.md")
for page in (ROOT / "docs").glob("*.md"):
    lay_out(page, page.name)
shutil.copytree(ROOT / "docs" / "images", PAGES / "images")
here = ROOT / "tools" / "docs"
shutil.copyfile(here / "site.css", PAGES / "site.css")
shutil.copyfile(here / "reference.md", PAGES / "reference.md")
notebooks = lay_out_notebooks()

config = (here / "mkdocs.yml").read_text(encoding="utf-8")
for page in PAGES.glob("*.md"):
    if f": {page.name}\n" not in config:
        sys.exit(f"tools/docs/mkdocs.yml: {page.name} stands nowhere in nav")
config = config.replace("SITE", str(SITE)).replace("THEME", str(here / "theme"))
config = re.sub(r"^( *)# notebooks\n", lambda match: "".join(f"{match.group(1)}{line}\n" for line in notebooks), config, flags=re.M)
(FOLDER / "mkdocs.yml").write_text(config, encoding="utf-8")
