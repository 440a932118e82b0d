"""Scenes: built in Python, from text and from files; the reader of scene files is the only judge of both."""

import copy
import os
import pathlib
import pickle
import re
import subprocess
import tempfile
import unittest

import numpy as np

import condyle
import knees

SCENES = [path for path in sorted((knees.SOURCE / "data").rglob("*.toml"))
          if not re.search(r"^(specimens|\[\[?(specimen|vary|study))", path.read_text(), re.MULTILINE)]

# Tables of docs/scene.md and the classes that stand for them, with those within.
CLASSES = {
    "[[body]]": (condyle.Body, condyle.Start),
    "[joint]": (condyle.Joint, condyle.Frame),
    "[[surface]]": (condyle.Surface, condyle.Region, condyle.Fit),
    "[[contact]]": (condyle.Contact,),
    "[[ligament]]": (condyle.Ligament, condyle.End),
    "[[wrap]]": (condyle.Wrap,),
    "[[condition]]": (condyle.Condition,),
    "[[load]]": (condyle.Load,),
    "[sweep]": (condyle.Sweep,),
    "[laxity]": (condyle.Laxity,),
    "[calibrate]": (condyle.Calibrate,),
    "[[calibrate.load]]": (condyle.CalibrateLoad,),
    "[[calibrate.parameter]]": (condyle.CalibrateParameter,),
    "[simulate]": (condyle.Simulate, condyle.Drive, condyle.Damper),
}


def documented_keys():
    """Pairs of a table and the words of its paragraph and of the next list of keys that may be keys."""
    words = {}
    table = None
    for line in (knees.SOURCE / "docs" / "scene.md").read_text().splitlines():
        named = re.match(r"`(\[\[?[a-z.]+\]\]?)`", line)
        if named:
            table = named.group(1) if named.group(1) in CLASSES else None
        row = re.match(r"\| `([a-z`, _]+)`", line)
        if table and row:
            words.setdefault(table, set()).update(re.split(r"[`, ]+", row.group(1)))
        if line.startswith("| kind") or line.startswith("| law"):
            continue
    return words


class Tables(unittest.TestCase):
    def test_every_documented_key_can_be_given(self):
        found = documented_keys()
        self.assertGreater(sum(map(len, found.values())), 30)
        for table, words in found.items():
            known = {key.removesuffix("_") for kind in CLASSES[table] for key in kind._keys}
            kinds = {"patch", "plane", "sphere", "cylinder", "ellipsoid", "torus", "polynomial", "toe-linear", "quadratic", "table",
                     # of the table of `sensitivities`
                     "value", "scale", "vector", "point", "shift", "modulus", "reference_strain", "slack_length", "stiffness",
                     "transition_strain"}
            self.assertLessEqual(words - kinds, known, table)

    def test_every_key_of_shipped_scenes_can_be_given_and_they_stay_the_same(self):
        self.assertGreater(len(SCENES), 5)
        for path in SCENES:
            scene = condyle.read_scene(path)
            again = condyle.Scene.from_text(scene._toml(functions_too=False), folder=path.parent)
            self.assertEqual(again._toml(False), scene._toml(False), path)
            self.assertEqual(scene.to_toml(), path.read_text(), path)

    def test_the_reader_knows_every_key_that_can_be_given(self):
        for kind, place in ((condyle.Body, "bodies"), (condyle.Surface, "surfaces"), (condyle.Contact, "contacts"),
                            (condyle.Ligament, "ligaments"), (condyle.Wrap, "wraps"), (condyle.Condition, "conditions"),
                            (condyle.Load, "loads"), (condyle.Units, "units"), (condyle.Joint, "joint"), (condyle.Sweep, "sweep"),
                            (condyle.Laxity, "laxity"), (condyle.Simulate, "simulate"), (condyle.Calibrate, "calibrate")):
            source = (knees.SOURCE / "src/condyle/scene_file").glob("*.cpp")
            text = "\n".join(path.read_text() for path in source)
            for key in kind._keys:
                if (kind, key) != (condyle.Load, "function"):
                    self.assertIn(f'"{key.removesuffix("_")}"', text, f"{place}: {key}")

    def test_a_misspelt_key_is_named_with_the_nearest(self):
        with self.assertRaisesRegex(TypeError, 'Ligament: unknown key stifness, did you mean "stiffness"'):
            condyle.Ligament("aACL", stifness=3)
        with self.assertRaisesRegex(AttributeError, "Body: unknown key mass_, expected|unknown key"):
            condyle.Body("femur").masse = 3
        with self.assertRaisesRegex(TypeError, 'unknown key ligament, did you mean "ligaments"'):
            condyle.Scene(ligament=[])
        with self.assertRaisesRegex(TypeError, "Joint: 1 arguments without a keyword"):
            condyle.Joint("right")

    def test_from_is_a_word_of_python_and_a_key_all_the_same(self):
        self.assertEqual(condyle.Sweep(**{"from": 0}), condyle.Sweep(from_=0))
        self.assertIn("from = 0", knees_scene(sweep=condyle.Sweep(vary="pull.scale", from_=0, to=1, step=1)).to_toml())


def knees_scene(**changes):
    scene = knees.spring()
    for key, value in changes.items():
        setattr(scene, key, value)
    return scene


class Reading(unittest.TestCase):
    def test_errors_are_the_line_that_the_program_prints(self):
        text = knees.PHANTOM.read_text().replace("stiffness", "stifness", 1).replace("../../meshes", str(knees.SOURCE / "meshes"))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "knee.toml"
            path.write_text(text)
            told = subprocess.run([knees.PROGRAM, "check", path], capture_output=True, text=True, check=False).stderr
            with self.assertRaises(condyle.InputError) as caught:
                condyle.read_scene(path)
            self.assertEqual(told, f"condyle: {caught.exception}\n")
            with self.assertRaises(ValueError) as caught:
                condyle.Scene.from_text(text)
            self.assertEqual(told.replace(str(path), "./<text>"), f"condyle: {caught.exception}\n")

    def test_a_scene_built_in_python_meets_the_same_checks(self):
        cases = (
            (dict(ligaments=[condyle.Ligament("s", ends=[], law="quadratic", stiffness=-1, slack_length=3)]), 'ligament.* "s": ends'),
            (dict(loads=[condyle.Load("pull", body="weight", kind="force", vector=[np.nan, 0, 0])]), '"pull": vector = .*nan'),
            (dict(loads=[condyle.Load("pull", body="weight", kind="force", vector=np.eye(3))]), '"pull": vector'),
            (dict(loads=[condyle.Load("pull", body="tibia", kind="force", vector=np.zeros(3))]), '"pull": body = "tibia"'),
            (dict(units=condyle.Units(length="inch", angle="deg", force="N")), "length = \"inch\""),
            (dict(units=None), "units"),
            (dict(bodies=[]), "body"),
            (dict(sweep=condyle.Sweep(vary="pull.scale", values=[])), "values"),
            (dict(sweep=condyle.Sweep(vary="pull.scale", values=[1, float("inf")])), "inf"),
        )
        for changes, expected in cases:
            with self.assertRaisesRegex(condyle.InputError, expected):
                knees_scene(**changes).check()
        with self.assertRaisesRegex(TypeError, "load 'pull': vector: object"):
            knees_scene(loads=[condyle.Load("pull", body="weight", kind="force", vector=object())]).check()
        with self.assertRaisesRegex(TypeError, "ligament: int"):
            knees_scene(ligaments=[3]).check()

    def test_texts_that_are_no_scenes(self):
        for text in ("", "a = ", "\x00", "[units]\nlength = 'mm'", "é", "a = 1979-05-27", "x" * 100000):
            with self.assertRaises(condyle.InputError):
                condyle.Scene.from_text(text)
        with self.assertRaisesRegex(TypeError, "text: int"):
            condyle.Scene.from_text(3)
        with self.assertRaisesRegex(condyle.InputError, "text: surrogates"):
            condyle.Scene.from_text("title = '\udc80'")
        with self.assertRaisesRegex(condyle.InputError, "no such file"):
            condyle.read_scene("missing.toml")
        with self.assertRaisesRegex(TypeError, "path: int"):
            condyle.read_scene(3)
        with self.assertRaisesRegex(condyle.InputError, "path = "):
            condyle.read_scene("a\0b")
        for scene in (3, None, "knee.toml", {}, [], object()):
            with self.assertRaisesRegex(TypeError, "scene: "):
                condyle.Model(scene)

    def test_names_with_quotes_and_odd_characters_come_through(self):
        for name in ('a"b', "tab\\t", "é ü 中", "a'b", "#", "\x7f..", "[x]"):
            scene = knees.spring()
            scene.ligaments[0].name = name
            self.assertEqual(condyle.Model(scene).ligaments, (name,))


class Changing(unittest.TestCase):
    def test_a_scene_that_was_read_can_be_changed(self):
        scene = condyle.read_scene(knees.PHANTOM)
        before = condyle.Solver(knees.phantom()).get("aACL.stiffness")
        scene.ligaments["aACL"].stiffness = 2 * before
        text = scene.to_toml()
        self.assertNotEqual(text, knees.PHANTOM.read_text())
        changed = condyle.Scene.from_text(text, folder=knees.PHANTOM.parent)
        self.assertEqual(changed.ligaments["aACL"].stiffness, 2 * before)
        scene.ligaments["aACL"].stiffness = before
        self.assertEqual(scene.to_toml(), knees.PHANTOM.read_text())
        with self.assertRaisesRegex(KeyError, 'did you mean "aACL"'):
            scene.ligaments["aACLL"]

    def test_a_key_that_is_deleted_is_not_given(self):
        scene = knees.spring(law="toe-linear", stiffness=1000, slack_length=10, transition_strain=0.04)
        del scene.ligaments["spring"].transition_strain
        self.assertEqual(scene, knees.spring(law="toe-linear", stiffness=1000, slack_length=10))
        self.assertNotIn("transition_strain", scene.to_toml() + repr(scene))
        with self.assertRaisesRegex(AttributeError, 'did you mean "stiffness"'):
            del scene.ligaments["spring"].stifness

    def test_scenes_are_compared_copied_and_pickled(self):
        scene = condyle.read_scene(knees.PHANTOM)
        for other in (copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))):
            self.assertEqual(other, scene)
            self.assertEqual(other.to_toml(), scene.to_toml())
            other.ligaments["aACL"].stiffness = np.float64(3)
            self.assertNotEqual(other, scene)
        self.assertEqual(knees.spring(), knees.spring())

    def test_save_writes_a_scene_that_the_program_reads(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "spring.toml"
            knees.spring().save(path)
            self.assertEqual(condyle.read_scene(path), knees.spring())
            subprocess.run([knees.PROGRAM, "check", path], check=True, capture_output=True)

    def test_a_scene_keeps_its_folder_when_the_working_folder_changes(self):
        here = os.getcwd()
        scene = condyle.read_scene(os.path.relpath(knees.PHANTOM))
        with tempfile.TemporaryDirectory() as folder:
            try:
                os.chdir(folder)
                scene.check()
                scene.save("there.toml")
                condyle.read_scene("there.toml").check()
            finally:
                os.chdir(here)
        scene.check()

    def test_a_byte_order_mark_is_no_part_of_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "mark.toml"
            path.write_text("\ufeff" + knees.spring().to_toml(), encoding="utf-8")
            self.assertEqual(condyle.read_scene(path), knees.spring())
            first = "\ufeffcalibrate = { measurements = 'm.csv' }\n" + knees.spring().to_toml()
            condyle.Scene.from_text(first, folder, check=False).save("moved.toml")
            try:
                moved = pathlib.Path("moved.toml").read_text(encoding="utf-8")
                self.assertIn(f'measurements = "{os.path.relpath(folder)}/m.csv"', moved)
            finally:
                os.unlink("moved.toml")

    def test_save_into_another_folder_finds_its_meshes(self):
        read, changed = condyle.read_scene(knees.PHANTOM), condyle.read_scene(knees.PHANTOM)
        changed.ligaments["aACL"].stiffness = 4000
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "phantom.toml"
            for scene in (read, changed):
                scene.save(path)
                saved = condyle.read_scene(path)
                for body, was in zip(saved.bodies, scene.bodies):
                    self.assertTrue(os.path.samefile(os.path.join(folder, body.mesh),
                                                     os.path.join(os.path.dirname(knees.PHANTOM), was.mesh)))
                saved.check()
            self.assertEqual(os.listdir(folder), ["phantom.toml"])
            with self.assertRaisesRegex(condyle.InputError, "missing"):
                read.save(pathlib.Path(folder) / "missing" / "phantom.toml")
            with self.assertRaisesRegex(condyle.InputError, "phantom.h5"):
                read.save(pathlib.Path(folder) / "phantom.h5")


if __name__ == "__main__":
    unittest.main()
