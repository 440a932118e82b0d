"""Laxity, comparisons and motions: the numbers of the program's files, what lives how long, bad input, threads."""

import gc
import pathlib
import tempfile
import unittest

import numpy as np

import condyle
import knees
from same_numbers import expect_same, program
from test_threads import in_threads

DATA = knees.SOURCE / "data"


def drawer(flexion=(0, 60), loads=(-1, 0, 1)):
    """A drawer test of two spheres on two planes."""
    scene = condyle.read_scene(DATA / "wismans-type" / "drawer.toml")
    scene.laxity.flexion = list(flexion)
    scene.sweep = condyle.Sweep(vary=scene.sweep.vary, values=list(loads))
    return scene


def two_balls(**simulate):
    """A ball that falls on another one along their line of centres: x is held."""
    scene = knees.ball_on_ball()
    scene.bodies["high"].mass, scene.bodies["high"].center = 0.5, [0, 0, 0]
    scene.bodies["high"].inertia = [[100, 0, 0], [0, 100, 0], [0, 0, 100]]
    scene.simulate = condyle.Simulate(**{"time": 0.02, "rate": 1000, "gravity": [0, -9810, 0],
                                         "hold": ["x", "z", "a", "b", "c"], **simulate})
    return scene


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def of_program(self, command, scene, *options):
        path = self.folder / "scene.toml"
        scene.save(path)
        return condyle.open_run(program(command, path, self.folder / "run.h5", *options))


class Laxity(Folder):
    def test_numbers_are_those_of_the_program(self):
        scene = drawer()
        run, theirs = condyle.laxity(scene), self.of_program("laxity", scene)
        self.assertEqual((run.kind, len(run)), ("laxity", 0))
        self.assertEqual(repr(run), '<condyle.Run "Wismans-type knee: drawer test": laxity>')
        expect_same(self, run.laxity, theirs.laxity)
        self.assertEqual(run.laxity.intact.ours.joint.anterior_drawer.shape, (2, 3))
        np.testing.assert_allclose(run.laxity.flexion, [0, 60], rtol=1e-15)
        self.assertEqual(run["laxity"].units("flexion"), "deg")
        coarse = condyle.laxity(scene, degree=6, strain=0.05)
        expect_same(self, coarse.laxity, self.of_program("laxity", scene, "--degree=6", "--strain=0.05").laxity)
        self.assertTrue((coarse.laxity.intact.reference.ligaments["LCL"] != run.laxity.intact.reference.ligaments["LCL"]).any())

    def test_a_cut_ligament_leaves_more_play(self):
        found = condyle.laxity(drawer([30], [-1, 1])).laxity
        play = [np.ptp(knee.ours.joint.anterior_drawer, axis=1)[0] for knee in (found.intact, found.cut)]
        self.assertGreater(play[1], 1.2 * play[0])

    def test_what_is_saved_is_what_was_found(self):
        path = self.folder / "laxity.h5"
        run = condyle.laxity(drawer())
        run.save(path)
        expect_same(self, condyle.open_run(path).laxity, run.laxity)
        self.assertIsNone(run.comparison)
        self.assertIsNone(condyle.sweep(knees.ball_on_ball()).laxity)

    def test_models_serve_as_well_and_threads_share_them(self):
        model = condyle.Model(drawer())
        alone = condyle.laxity(model)
        for run in in_threads(3, lambda i: condyle.laxity(model)):
            expect_same(self, run.laxity, alone.laxity)

    def test_arrays_outlive_their_run(self):
        run = condyle.laxity(drawer([0]))
        force = run.laxity.intact.ours.ligaments["LCL"]
        expected = force.copy()
        del run
        gc.collect()
        np.testing.assert_array_equal(force, expected)
        self.assertFalse(force.flags.writeable)

    def test_bad_input(self):
        with self.assertRaisesRegex(condyle.InputError, r"\[laxity\] is missing"):
            condyle.laxity(knees.ball_on_ball())
        scene = drawer([0])
        for wrong, error, words in (({"degree": 0}, condyle.InputError, "degree = 0, expected"),
                                    ({"degree": 10**30}, condyle.InputError, "degree = 1000"),
                                    ({"degree": 3.5}, TypeError, "degree: float"), ({"degree": True}, TypeError, "degree: bool"),
                                    ({"strain": 2}, condyle.InputError, "strain = 2, expected"),
                                    ({"strain": float("nan")}, condyle.InputError, "strain = nan"),
                                    ({"strain": "a"}, TypeError, "strain: str"), ({"progress": 1}, TypeError, "progress")):
            with self.assertRaisesRegex(error, words):
                condyle.laxity(scene, **wrong)
        for nothing in (None, 3, "drawer.toml"):
            with self.assertRaisesRegex(TypeError, "scene: "):
                condyle.laxity(nothing)
        scene.loads[0].function = lambda p, R: ([0, 0, 0], [0, 0, 0])
        with self.assertRaisesRegex(condyle.InputError, "function: is a function"):
            condyle.laxity(scene)

    def test_progress_is_told_and_what_it_raises_comes_through(self):
        told = []
        condyle.laxity(drawer(), progress=lambda done, total: told.append((done, total)))
        self.assertEqual(told, [(k, 4) for k in range(1, 5)])

        def stop(done, total):
            raise LookupError(f"{done} of {total}")
        with self.assertRaisesRegex(LookupError, "^1 of 4"):
            condyle.laxity(drawer(), progress=stop)


class Comparison(Folder):
    def test_numbers_are_those_of_the_program(self):
        scene = condyle.read_scene(DATA / "wismans-type" / "knee.toml")
        scene.sweep = condyle.Sweep(vary=scene.sweep.vary, values=[0, 20, 40])
        told = []
        run = condyle.compare(scene, progress=lambda done, total: told.append((done, total)))
        theirs = self.of_program("compare", scene)
        self.assertEqual((run.kind, len(run)), ("comparison", 3))
        expect_same(self, run.comparison, theirs.comparison, but=["seconds"])
        expect_same(self, run["reference"], theirs["reference"], but=["seconds"])
        expect_same(self, run["sweep"], theirs["sweep"], but=["seconds"])
        self.assertEqual(told[-1][0], told[-1][1])
        ours, reference = (run.comparison["quantities/adduction"][model] for model in ("ours", "reference"))
        self.assertLess(np.abs(ours - reference).max(), 5)

    def test_bad_input(self):
        with self.assertRaisesRegex(condyle.InputError, "Wismans|expected"):
            condyle.compare(knees.ball_on_ball())
        scene = condyle.read_scene(DATA / "wismans-type" / "knee.toml")
        for wrong in ({"degree": 99}, {"strain": 0}):
            with self.assertRaisesRegex(condyle.InputError, f"{next(iter(wrong))} = "):
                condyle.compare(scene, **wrong)
        scene.sweep = None
        with self.assertRaisesRegex(condyle.InputError, r"\[sweep\]"):
            condyle.compare(scene)


class Motion(Folder):
    def test_numbers_are_those_of_the_program(self):
        scene = two_balls()
        run, theirs = condyle.simulate(scene), self.of_program("simulate", scene)
        self.assertEqual(run.kind, "simulation")
        self.assertEqual(run.swept, "time")
        expect_same(self, run.simulation, theirs.simulation)
        expect_same(self, run["sweep"], theirs["sweep"], but=["seconds"])
        np.testing.assert_array_equal(run.values, run.simulation.time)

    def test_a_mass_on_a_spring_swings_as_the_formula_says(self):
        scene = knees.spring(force=5.0)
        weight = scene.bodies["weight"]
        weight.mass, weight.center, weight.inertia = 0.5, [0, 0, 0], [[100, 0, 0], [0, 100, 0], [0, 0, 100]]
        at_once = condyle.Drive(load="pull", shape="table", times=[0, 1e-7, 1], factors=[0, 1, 1])
        scene.simulate = condyle.Simulate(time=0.02, rate=1000, gravity=[0, 0, 0], hold=["y", "z", "a", "b", "c"], drive=[at_once])
        run = condyle.simulate(scene)
        time, energy = run.simulation.time, run.simulation.energy
        frequency = np.sqrt(100e3 / 0.5)  # rad/s, of N/m and kg
        expected = run.translation[0, 0] + 5.0 / 100.0 * (1 - np.cos(frequency * time))
        np.testing.assert_allclose(run.translation[:, 0], expected, atol=1e-5)
        self.assertLess(np.ptp(energy.balance), 1e-5 * energy.kinetic.max())

    def test_bad_input_and_progress(self):
        with self.assertRaisesRegex(condyle.InputError, r"\[simulate\] is missing"):
            condyle.simulate(knees.ball_on_ball())
        scene = two_balls()
        scene.bodies["high"].mass = None
        with self.assertRaises(condyle.InputError):
            condyle.simulate(scene)

        def stop(done, total):
            raise LookupError(f"{done} of {total}")
        with self.assertRaisesRegex(LookupError, "of 2[01]"):
            condyle.simulate(two_balls(), progress=stop)


if __name__ == "__main__":
    unittest.main()
