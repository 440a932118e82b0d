"""The notebooks of docs/notebooks, each run from its first cell to its last by nbconvert; what they assert they assert there.

Ends with 77 where nbconvert, ipykernel or matplotlib is not installed."""

import base64
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import condyle
import knees

NOTEBOOKS = sorted((knees.SOURCE / "docs" / "notebooks").glob("*.ipynb"))


def sources(notebook):
    return ["".join(cell["source"]) for cell in json.loads(notebook.read_text())["cells"] if cell["cell_type"] == "code"]


class Written(unittest.TestCase):
    def test_nothing_is_stored_but_text(self):
        self.assertEqual(len(NOTEBOOKS), 4)
        for notebook in NOTEBOOKS:
            self.assertLess(notebook.stat().st_size, 20000, notebook)
            for cell in json.loads(notebook.read_text())["cells"]:
                self.assertFalse(cell.get("outputs"), notebook)
                self.assertIsNone(cell.get("execution_count"), notebook)

    def test_each_asserts_something(self):
        for notebook in NOTEBOOKS:
            self.assertGreater(sum(source.count("\nassert ") for source in sources(notebook)), 2, notebook)


class Executed(unittest.TestCase):
    def test_every_cell_runs_and_draws_what_it_should(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            here = folder / "docs" / "notebooks"
            shutil.copytree(knees.SOURCE / "docs" / "notebooks", here)
            for needed in ("data", "meshes"):
                (folder / needed).symlink_to(knees.SOURCE / needed)
            done = subprocess.run(
                [sys.executable, "-X", "frozen_modules=off", "-m", "nbconvert", "--execute", "--to", "notebook", "--output-dir",
                 folder / "out", *(here / notebook.name for notebook in NOTEBOOKS)],
                cwd=here, env=self.surroundings(folder), capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr[-3000:])
            for notebook in NOTEBOOKS:
                self.look_at(folder / "out" / notebook.name)

    def surroundings(self, folder):
        """This Python with this condyle, and nothing of the user's own."""
        kernel = folder / "jupyter" / "kernels" / "python3"
        kernel.mkdir(parents=True)
        (kernel / "kernel.json").write_text(json.dumps(
            {"argv": [sys.executable, "-X", "frozen_modules=off", "-m", "ipykernel_launcher", "-f", "{connection_file}"],
             "display_name": "Python 3", "language": "python"}))
        own = {"JUPYTER_PATH": folder / "jupyter", "HOME": folder, "IPYTHONDIR": folder / "ipython",
               "JUPYTER_CONFIG_DIR": folder / "jupyter", "JUPYTER_RUNTIME_DIR": folder / "runtime",
               "MPLCONFIGDIR": folder / "matplotlib", "PYTHONPATH": pathlib.Path(condyle.__file__).parents[1]}
        return {**os.environ, **{key: str(value) for key, value in own.items()}}

    def look_at(self, notebook):
        figures = 0
        for cell in json.loads(notebook.read_text())["cells"]:
            for output in cell.get("outputs", []):
                self.assertNotIn("stderr", output.get("name", ""), f"{notebook.name}: {output.get('text')}")
                if "image/png" in output.get("data", {}):
                    figures += 1
                    self.assertLess(len(base64.b64decode(output["data"]["image/png"])), 150000, notebook.name)
        shown = sum("plt.show()" in "".join(cell["source"]) for cell in json.loads(notebook.read_text())["cells"])
        self.assertEqual(figures, shown, notebook.name)
        self.assertGreater(figures, 1, notebook.name)


if __name__ == "__main__":
    missing = [name for name in ("nbconvert", "ipykernel", "matplotlib") if importlib.util.find_spec(name) is None]
    if missing:
        print("not run: Python has no", ", ".join(missing))
        sys.exit(77)
    unittest.main()
