"""Scenes of two meshes."""

import pathlib
import subprocess
import unittest

import condyle
import knees
from test_studies import Folder

FEMUR, TIBIA = (knees.SOURCE / "meshes" / name for name in ("femur.stl", "tibia.stl"))


class NewScenes(Folder):
    def test_it_is_what_the_program_writes(self):
        path = self.folder / "new.toml"
        subprocess.run([knees.PROGRAM, "new", FEMUR, TIBIA, "--template", knees.PHANTOM, "-o", path], check=True, capture_output=True)
        theirs = condyle.read_scene(path)
        ours = condyle.new_scene(FEMUR, TIBIA, knees.PHANTOM, folder=self.folder)
        self.assertEqual(ours, theirs)
        self.assertEqual(ours.to_toml(), path.read_text())
        self.assertEqual(ours.joint.side, "right")
        self.assertEqual(pathlib.Path(self.folder, ours.bodies[0].mesh).resolve(), FEMUR.resolve())
        self.assertTrue(condyle.Model(ours).solve(flexion=30).converged)

    def test_bad_input(self):
        good = {"femur": FEMUR, "tibia": TIBIA, "template": knees.PHANTOM}
        for wrong, error, words in (({"femur": self.folder / "missing.stl"}, condyle.InputError, "missing.stl"),
                                    ({"tibia": FEMUR}, condyle.InputError, "femur"), ({"femur": 3}, TypeError, "femur: int"),
                                    ({"template": FEMUR}, condyle.InputError, "femur.stl"),
                                    ({"template": None}, TypeError, "template: "),
                                    ({"side": "both"}, condyle.InputError, "side = 'both', expected \"right\", \"left\", or None"),
                                    ({"side": 1}, condyle.InputError, "side = 1"),
                                    ({"units": "inch"}, condyle.InputError, "units = 'inch'"),
                                    ({"cartilage": [FEMUR]}, condyle.InputError, "cartilage: 1 paths, expected two"),
                                    ({"cartilage": str(FEMUR)}, TypeError, "cartilage: "), ({"cartilage": 3}, TypeError, "cartilage: "),
                                    ({"folder": 3}, TypeError, "folder: int")):
            with self.assertRaisesRegex(error, words):
                condyle.new_scene(**{**good, **wrong})


if __name__ == "__main__":
    unittest.main()
