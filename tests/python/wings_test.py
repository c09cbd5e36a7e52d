"""scripts/wings finds what goes against the arrows. Arguments: the source tree."""
import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = sys.argv.pop(1)


def load():
    loader = importlib.machinery.SourceFileLoader("wings", os.path.join(ROOT, "scripts", "wings"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("wings", loader))
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


WINGS = load()


class Wings(unittest.TestCase):
    def violations(self, files, exceptions=()):
        """Of a tree that has these files, by path, with these contents."""
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for path, text in files.items():
                    os.makedirs(os.path.dirname(path), exist_ok=True)
                    with open(path, "w", encoding="utf-8") as file:
                        file.write(text)
                return WINGS.violations(list(files), set(exceptions))
            finally:
                os.chdir(before)

    def test_the_sources_follow_the_arrows(self):
        run = subprocess.run([os.path.join(ROOT, "scripts", "wings")], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_an_include_along_an_arrow_is_allowed(self):
        files = {"platform/study/a.cpp": "#include <result/b.h>\n", "platform/result/b.h": "#include <vp/text.h>\n",
                 "vp/include/vp/text.h": ""}
        self.assertEqual(self.violations(files), [])

    def test_an_include_against_an_arrow_is_found_with_its_line(self):
        files = {"platform/result/a.cpp": "\n#include <chip/b.h>\n", "platform/chip/b.h": ""}
        self.assertEqual(self.violations(files),
                         ["platform/result/a.cpp:2: platform/result may not include platform/chip: platform/chip/b.h"])

    def test_an_include_beside_the_file_is_seen_too(self):
        files = {"vp/wave/a.cpp": '#include "../clock/b.h"\n', "vp/clock/b.h": ""}
        self.assertEqual(len(self.violations(files)), 1)

    def test_systemc_stays_out_of_the_readers_of_waves(self):
        files = {"vp/wave/a.cpp": "#include <vp/clock.h>\n", "vp/include/vp/clock.h": ""}
        self.assertEqual(len(self.violations(files)), 1)

    def test_an_exception_leaves_the_list_with_its_cause(self):
        files = {"platform/result/a.cpp": "#include <chip/b.h>\n", "platform/chip/b.h": ""}
        exception = "platform/result/a.cpp platform/chip/b.h"
        self.assertEqual(self.violations(files, [exception]), [])
        files["platform/result/a.cpp"] = ""
        self.assertEqual(self.violations(files, [exception]),
                         ["scripts/wings: mended, so take it out of the exceptions: " + exception])


if __name__ == "__main__":
    unittest.main()
