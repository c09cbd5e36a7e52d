#!/usr/bin/env python3
"""Checks the links inside a built site: every file and every anchor that a page names must be there.

    scripts/check_links.py FOLDER     prints each broken link as "page: link"; exit code 1 if there is one

Links to other hosts are not followed. Pages of Doxygen (api/) are targets only: Doxygen checks its own.
"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif name in ("href", "src") and value:
                self.links.append(value)


def broken(root, pages):
    for path, page in pages.items():
        if path.relative_to(root).parts[0] == "api" or path.name == "404.html":
            continue
        for link in page.links:
            url = urllib.parse.urlsplit(link)
            if url.scheme or url.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
            anchors = pages[target].anchors if target in pages else None
            if not target.exists() or (url.fragment and anchors is not None and url.fragment not in anchors):
                yield f"{path.relative_to(root)}: {link}"


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        sys.exit("usage: scripts/check_links.py FOLDER")
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in root.rglob("*.html")}
    if not pages:
        sys.exit(f"{root}: no page to check")
    found = sorted(set(broken(root, pages)))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
