"""check_site.py SITE: every link within a site leads to a file and an anchor that are there, and no page loads anything from
elsewhere. Ends with 1 and a line for each that does not."""

import html.parser
import pathlib
import re
import sys
import urllib.parse

SITE = pathlib.Path(sys.argv[1]).resolve()


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.anchors, self.links, self.loads = set(), [], []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        for name in ("id", "name"):
            if attrs.get(name) and (name == "id" or tag == "a"):
                self.anchors.add(attrs[name])
        if tag == "a" and attrs.get("href"):
            self.links.append(attrs["href"])
        elif tag == "link" and attrs.get("href") and attrs.get("rel") not in ("canonical", "next", "prev"):
            self.loads.append(attrs["href"])
        elif attrs.get("src"):
            self.loads.append(attrs["src"])


def target_of(file, link):
    """File and anchor within the site; None for what leads elsewhere."""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = urllib.parse.unquote(parts.path)
    target = (file.parent / path).resolve() if path else file
    if target.is_dir():
        target /= "index.html"
    return target, urllib.parse.unquote(parts.fragment)


pages = {file: Page(file) for file in sorted(SITE.rglob("*.html"))}
faults, count = [], 0
for file, page in pages.items():
    if file.name == "404.html":
        continue  # its links are meant for the root of a server
    name = file.relative_to(SITE)
    for link in page.links + page.loads:
        target = target_of(file, link)
        if target is None:
            if link in page.loads and not link.startswith(("data:", "javascript:")):
                faults.append(f"{name}: loads {link}")
            continue
        count += 1
        if not target[0].exists():
            faults.append(f"{name}: {link} is not there")
        # The summaries of doxygen name places of parts that a page goes without.
        elif target[1] and target[0] in pages and target[1] not in pages[target[0]].anchors and link != "#nested-classes":
            faults.append(f"{name}: {link} has no such place")
for file in SITE.rglob("*.css"):
    for address in re.findall(r"(?:url\(|@import )[\"']?((?:https?:)?//[^\"')\s]+)", file.read_text(encoding="utf-8")):
        faults.append(f"{file.relative_to(SITE)}: loads {address}")
print("\n".join(faults) if faults else f"{len(pages)} pages, {count} links within the site, all of them lead somewhere; nothing is loaded from elsewhere")
sys.exit(bool(faults))
