"""The program of docs/python.md runs, and prints what the page says."""

import contextlib
import io
import os
import re
import tempfile
import unittest

PAGE = os.path.join(os.environ["PIA_SOURCE"], "docs", "python.md")


class Tutorial(unittest.TestCase):
    maxDiff = None

    def test_all_of_it_runs_in_order(self):
        with open(PAGE) as file:
            text = file.read()
        blocks = re.findall(r"```(python|text)\n(.*?)```", text, re.DOTALL)
        self.assertGreater(len(blocks), 10)
        names, home = {}, os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for kind, block in blocks:
                    if kind == "text":
                        self.assertEqual(printed, self.rounded(block))
                        continue
                    out = io.StringIO()
                    with contextlib.redirect_stdout(out):
                        exec(compile(block, "docs/python.md", "exec"), names)
                    printed = self.rounded(out.getvalue())
            finally:
                os.chdir(home)

    def rounded(self, text):
        """Numbers with a point to two digits."""
        return re.sub(r"\d+\.\d+(e-?\d+)?", lambda number: f"{float(number[0]):.2g}", text)


if __name__ == "__main__":
    unittest.main()
