"""What is written down of the module: docstrings, stubs, docs/python.md."""

import ast
import contextlib
import importlib.util
import inspect
import io
import pathlib
import re
import subprocess
import sys
import unittest

import condyle
import knees

PACKAGE = pathlib.Path(condyle.__file__).parent


class Docstrings(unittest.TestCase):
    def test_every_public_name_has_one(self):
        for name in condyle.__all__:
            thing = getattr(condyle, name)
            if name == "__version__":
                continue
            self.assertTrue((thing.__doc__ or "").strip(), name)
            own = [] if not inspect.isclass(thing) or issubclass(thing, (int, list, ValueError)) else vars(thing)
            for member in own:
                if not member.startswith("_") and (callable(getattr(thing, member)) or isinstance(vars(thing)[member], property)):
                    self.assertTrue((getattr(thing, member).__doc__ or "").strip(), f"{name}.{member}")

    def test_none_speaks_of_c_plus_plus_and_all_are_at_home_in_condyle(self):
        for name in condyle.__all__:
            thing = getattr(condyle, name)
            for member in [thing, *(getattr(thing, member) for member in dir(thing))]:
                self.assertNotIn("::", str(getattr(member, "__doc__", "")), name)
            if name != "__version__":
                self.assertEqual(thing.__module__, "condyle", name)

    def test_help_says_units_and_shapes(self):
        text = " ".join(condyle.sweep.__doc__.split())
        for words in ("values: (n,)", "scene's unit", "Returns a Run", "InputError", "status"):
            self.assertIn(words, text)
        self.assertIn("[mm]", condyle.Run.translation.__doc__)
        self.assertIn("sensitivities", str(inspect.signature(condyle.sweep)))

    def test_the_module_says_how_it_was_built(self):
        info = condyle.build_info()
        self.assertEqual(info["version"], condyle.__version__)
        told = subprocess.run([knees.PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout
        for fact in (info["version"], info["made_by"], info["compiler"], "Eigen " + info["libraries"]["Eigen"]):
            self.assertIn(fact, told)


class Stubs(unittest.TestCase):
    def test_every_public_name_has_one(self):
        stub = ast.parse((PACKAGE / "__init__.pyi").read_text())
        named = {alias.asname for node in ast.walk(stub) if isinstance(node, ast.ImportFrom) for alias in node.names}
        named |= {node.name for node in stub.body if isinstance(node, ast.ClassDef)}
        self.assertEqual(set(condyle.__all__) - {"Tables", "Table"} - named, set())
        classes = {node.name: {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
                   for node in ast.parse((PACKAGE / "_condyle.pyi").read_text()).body if isinstance(node, ast.ClassDef)}
        functions = {node.name for node in ast.parse((PACKAGE / "_condyle.pyi").read_text()).body
                     if isinstance(node, ast.FunctionDef)}
        compiled = sys.modules["condyle._condyle"]
        for name, thing in vars(compiled).items():
            if inspect.isclass(thing):
                members = {member for member in vars(thing) if not member.startswith("_")}
                self.assertEqual(members, {member for member in classes[name] if not member.startswith("_")}, name)
            elif callable(thing):
                self.assertIn(name, functions)
        statuses = [node for node in stub.body if isinstance(node, ast.ClassDef) and node.name == "Status"][0]
        self.assertEqual([(line.targets[0].id, line.value.value) for line in statuses.body],
                         [(status.name, status.value) for status in condyle.Status])

    @unittest.skipIf(importlib.util.find_spec("mypy") is None, "mypy is not installed")
    def test_mypy_accepts_them(self):
        told = subprocess.run([sys.executable, "-m", "mypy", "--no-incremental", "--cache-dir=/dev/null", "-p", "condyle"],
                              capture_output=True, text=True, check=False, cwd=PACKAGE.parent)
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)


class Page(unittest.TestCase):
    def test_its_examples_run(self):
        page = knees.SOURCE / "docs" / "python.md"
        text = page.read_text()
        blocks = list(re.finditer(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL))
        self.assertGreater(len(blocks), 5)
        names = {}
        for block in blocks:
            line = text[:block.start(1)].count("\n")
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile("\n" * line + block.group(1), page, "exec"), names)


if __name__ == "__main__":
    unittest.main()
