"""The examples: examples_test.py MARKERVP EXAMPLES BUILT [--only NAME] [--update]

Each runs by its run.sh in a copy of its folder, and must print what its README.md shows in its block ```output. --update writes
that instead. BUILT has the folders of what the examples compile; what needs Verilator is built by install_rtl_test, which asks for
that one only.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ONLY = sys.argv[sys.argv.index("--only") + 1] if "--only" in sys.argv else None
UPDATE = "--update" in sys.argv
PROGRAM, EXAMPLES, BUILT = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
WITH_RTL = ["07_own_rtl"]
BLOCK = re.compile(r"(?s)```output\n(.*?)```\n")
# A program that was built without Node.js has no pages, and says so.
PAGE = re.compile(r", report\.html to look at|\nno report\.html: [^\n]*")


def chosen():
    names = sorted(folder.name for folder in EXAMPLES.iterdir() if (folder / "run.sh").exists())
    return [name for name in names if (name == ONLY if ONLY else name not in WITH_RTL)]


class Examples(unittest.TestCase):
    maxDiff = None

    def output(self, folder):
        """What its run.sh prints, in a folder that has nothing else of the source tree."""
        environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"}
        if (folder / "CMakeLists.txt").exists():
            built = BUILT / folder.name
            self.assertTrue(built.is_dir(), f"{built} is not built")
            environment["BUILD"] = os.path.relpath(built, folder)
        ended = subprocess.run(["./run.sh"], cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        return ended.stdout

    def test_each_prints_what_its_readme_shows(self):
        self.assertEqual(len(chosen()), 1 if ONLY else 8)
        for name in chosen():
            with self.subTest(name), tempfile.TemporaryDirectory() as place:
                copy = shutil.copytree(EXAMPLES / name, pathlib.Path(place) / name)
                said = self.output(copy)
                readme = EXAMPLES / name / "README.md"
                text = readme.read_text(encoding="utf-8")
                shown, = BLOCK.findall(text)
                if UPDATE:
                    readme.write_text(BLOCK.sub(lambda _: f"```output\n{said}```\n", text), encoding="utf-8")
                else:
                    self.assertEqual(PAGE.sub("", said), PAGE.sub("", shown))

    def test_the_list_names_each(self):
        listed = re.findall(r"\]\((\d\d_\w+)/README\.md\)", (EXAMPLES / "README.md").read_text(encoding="utf-8"))
        self.assertEqual(listed, [folder.name for folder in sorted(EXAMPLES.iterdir()) if folder.is_dir()])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
