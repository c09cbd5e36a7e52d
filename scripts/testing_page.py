"""Puts what a script counted into docs/testing.md, between two comments that name the script."""
import os

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "docs", "testing.md")


def put(name, script, text):
    """Replaces what is between `<!-- name: script -->` and `<!-- end of name -->`."""
    begin, end = "<!-- %s: %s -->\n" % (name, script), "<!-- end of %s -->\n" % name
    with open(PAGE, encoding="utf-8") as file:
        page = file.read()
    before, rest = page.split(begin)
    after = rest.split(end)[1]
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(before + begin + "\n" + text + "\n" + end + after)
