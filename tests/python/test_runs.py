"""Runs: columns that look into C++, who keeps whom alive, and runs of files."""

import copy
import gc
import pathlib
import pickle
import subprocess
import tempfile
import unittest
import weakref

import numpy as np

import condyle
import knees

try:
    import h5py
except ImportError:
    h5py = None


def with_layers() -> condyle.Scene:
    """Two balls with elastic layers, and derivatives."""
    scene = knees.ball_on_ball(force=100)
    for surface in scene.surfaces:
        surface.modulus, surface.poisson, surface.layer = 10, 0.4, 3
    scene.contacts[0].law = "layer"
    scene.sweep.sensitivities = ["press.scale", "press.vector"]
    return scene


class Columns(unittest.TestCase):
    def test_arrays_are_read_only_views_and_not_copied(self):
        run = condyle.sweep(knees.ball_on_ball())
        for array in (run.values, run.status, run.translation, run.rotation, run.contacts["balls"].force):
            self.assertFalse(array.flags.writeable)
            self.assertFalse(array.flags.owndata)
            with self.assertRaisesRegex(ValueError, "read-only|WRITEABLE|writeable"):
                array[0] = 0
            with self.assertRaises(ValueError):
                array.flags.writeable = True
        self.assertEqual(run.translation.__array_interface__["data"], run.translation.__array_interface__["data"])
        mine = np.array(run.translation)
        mine[0] = 7
        self.assertNotEqual(run.translation[0, 0], 7)

    def test_arrays_outlive_their_run(self):
        run = condyle.sweep(knees.ball_on_ball())
        force, ligaments, expected = run.contacts["balls"].force, run["sweep/contacts"], run.contacts["balls"].force.copy()
        pose = run[1]
        del run
        gc.collect()
        rubbish = [bytearray(1000) for _ in range(1000)]
        np.testing.assert_array_equal(force, expected)
        self.assertEqual(ligaments["balls"].force[1], expected[1])
        self.assertEqual(pose.contacts["balls"].force, expected[1])
        self.assertEqual(len(rubbish), 1000)
        numbers = knees.phantom().solve(flexion=10).translation
        gc.collect()
        self.assertTrue(np.isfinite(numbers).all())

    def test_nothing_leaks_where_runs_come_and_go(self):
        class Law:
            def __call__(self, length):
                return 100 * (length - 10), 100, 50 * (length - 10) ** 2
        law = Law()
        alive = weakref.ref(law)
        run = condyle.sweep(knees.spring(law=law))
        force = run.ligaments["spring"].force
        del law, run
        gc.collect()
        self.assertIsNotNone(alive())  # the array keeps its run, and that its model
        del force
        gc.collect()
        self.assertIsNone(alive())

    def test_a_row_of_a_run_is_a_pose(self):
        run = condyle.sweep(knees.ball_on_ball())
        self.assertEqual(len(run), 3)
        self.assertEqual([pose.value for pose in run], [0, 5, 10])
        self.assertEqual(run[-1].contacts["balls"].force, run.contacts["balls"].force[-1])
        np.testing.assert_array_equal(run[1].pose.rotation, run.rotation[1])
        self.assertEqual(run[0].reason, "")
        scene = knees.ball_on_ball()
        scene.contacts[0].name = "roughness"  # as columns that are no poses' are called
        self.assertEqual(np.shape(condyle.sweep(scene)[1].contacts["roughness"].force), ())
        for i in (3, -4, 10**30):
            with self.assertRaises((IndexError, OverflowError)):
                run[i]
        with self.assertRaisesRegex(TypeError, "by their number"):
            run[1.5]

    def test_fields_of_layers_are_those_of_each_pose(self):
        run = condyle.sweep(with_layers())
        self.assertTrue(run.converged.all())
        field = run["sweep/contacts/balls/pressure/low ball"]
        self.assertEqual(len(field.pressure), field.first[-1])
        for i, pose in enumerate(run):
            mine = pose.contacts["balls"].pressure["low ball"]
            np.testing.assert_array_equal(mine.pressure, field.pressure[field.first[i]:field.first[i + 1]])
            np.testing.assert_array_equal(mine.point, field.point[field.first[i]:field.first[i + 1]])
            self.assertEqual(pose.contacts["balls"].area, run.contacts["balls"].area[i])
        self.assertEqual(run.sensitivities.parameters[0], "press.scale")
        self.assertEqual(run.sensitivities["contacts/balls/force"].shape, (3, 4))
        for pose in run:  # a parameter has no row for each pose
            self.assertEqual(pose.sensitivities.parameters, run.sensitivities.parameters)
            self.assertEqual(pose["sensitivities/parameter_units"], run["sweep/sensitivities/parameter_units"])

    def test_groups_say_units_and_meanings(self):
        run = condyle.sweep(knees.phantom(), [0, 60])
        self.assertEqual(run["sweep"].units("value"), "deg")
        self.assertEqual(run.joint.units("flexion"), "deg")
        self.assertEqual(run.ligaments["aACL"].units("force"), "N")
        self.assertEqual(run["sweep"].meaning("status")[0], "converged")
        self.assertIn("aACL", dict(run.ligaments.items()))
        self.assertIn("force", dir(run.ligaments["aACL"]))
        self.assertNotIn("aCL", run.ligaments)
        with self.assertRaisesRegex(KeyError, 'did you mean "aACL"'):
            run.ligaments["aACLL"]
        with self.assertRaisesRegex(AttributeError, 'did you mean "force"'):
            run.ligaments["aACL"].forces
        with self.assertRaises(KeyError):
            run["sweep/ligaments/aACL/force/more"]
        for place in ("", "/", "//", "sweep//", "no", "sweep/no", "sweep/value/"):
            try:
                run[place]
            except KeyError:
                pass

    def test_runs_are_not_pickled_and_columns_are(self):
        run = condyle.sweep(knees.ball_on_ball())
        for thing in (run, run.contacts, knees.phantom(), condyle.Solver(knees.phantom()), knees.phantom().solve()):
            with self.assertRaisesRegex(TypeError, "pickle"):
                pickle.dumps(thing)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(run.translation)), run.translation)
        np.testing.assert_array_equal(copy.deepcopy(run.translation), run.translation)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_program_reads_what_python_saves(self):
        path = self.folder / "run.h5"
        condyle.sweep(knees.phantom(), [0, 30, 60]).save(path)
        subprocess.run([knees.PROGRAM, "verify", path], check=True, capture_output=True)

    def test_a_file_may_go_while_its_run_stays(self):
        path = self.folder / "run.h5"
        condyle.sweep(with_layers()).save(path)
        opened = condyle.open_run(path)
        path.unlink()
        self.assertEqual(opened.file, str(path))
        self.assertEqual(opened.contacts["balls"].force.shape, (3,))
        opened.save(self.folder / "again.h5")
        again = condyle.open_run(self.folder / "again.h5")
        np.testing.assert_array_equal(again.translation, opened.translation)

    def test_files_that_are_no_runs(self):
        text, cut, empty = self.folder / "text.h5", self.folder / "cut.h5", self.folder / "empty.h5"
        condyle.sweep(knees.ball_on_ball()).save(cut)
        cut.write_bytes(cut.read_bytes()[:5000])
        text.write_text("no run")
        empty.touch()
        for path in (text, cut, empty, self.folder, self.folder / "missing.h5"):
            with self.assertRaisesRegex(condyle.InputError, str(path)):
                condyle.open_run(path)
        with self.assertRaisesRegex(condyle.InputError, "is a folder, expected a run"):
            condyle.open_run(self.folder)
        for path in (3, None, []):
            with self.assertRaisesRegex(TypeError, "path: "):
                condyle.open_run(path)
        run = condyle.sweep(knees.ball_on_ball())
        with self.assertRaisesRegex(condyle.InputError, "missing"):
            run.save(self.folder / "missing" / "run.h5")
        with self.assertRaises(condyle.InputError):
            run.save(self.folder)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["cut.h5", "empty.h5", "text.h5"])

    @unittest.skipIf(h5py is None, "h5py is not installed")
    def test_what_others_add_to_a_file_is_read_or_passed_over(self):
        path = self.folder / "run.h5"
        run = condyle.sweep(knees.ball_on_ball())
        run.save(path)
        with h5py.File(path, "r+") as file:
            notes = file.create_group("notes")
            notes["ids"] = np.array([2**40, -1])
            notes["flags"] = np.array([True, False])
            notes["fixed"] = np.array([b"ab", b"c"])
            notes["pair"] = np.zeros(2, dtype=[("a", "f8"), ("b", "i4")])
            notes["single"] = np.float32(0.5)
            notes["small"] = np.array([[1, 2], [3, 4]], dtype=np.uint8)
            del file["sweep/value"].attrs["units"]
        opened = condyle.open_run(path)
        np.testing.assert_array_equal(opened["notes"].ids, [2**40, -1])
        np.testing.assert_array_equal(opened["notes"].small, [[1, 2], [3, 4]])
        self.assertEqual((opened["notes"].single, opened["sweep"].units("value")), (0.5, ""))
        self.assertEqual(set(opened["notes"]), {"ids", "single", "small"})
        np.testing.assert_array_equal(opened.translation, run.translation)

    def test_a_run_of_any_kind_is_opened(self):
        scene = self.folder / "balls.toml"
        knees.ball_on_ball().save(scene)
        fitted = self.folder / "fit.h5"
        subprocess.run([knees.PROGRAM, "fit", knees.PHANTOM, "-o", fitted, "--quiet"], check=True)
        run = condyle.open_run(fitted)
        self.assertEqual((run.kind, len(run)), ("fit", 0))
        with self.assertRaisesRegex(condyle.InputError, '"fit" has no poses'):
            run.translation
        ours = condyle.fit(condyle.read_scene(knees.PHANTOM)).patches["medial condyle"]
        np.testing.assert_array_equal(run.patches["medial condyle"].control_points, ours.control_points)
        self.assertEqual(ours.rms_mm, run.patches["medial condyle"].rms_mm)

    def test_sweeps_vary_what_they_are_asked_to(self):
        run = condyle.sweep(knees.phantom(), [1, 1.5, 2], vary="compression.scale", sensitivities=["compression.scale"])
        self.assertEqual(run.swept, "compression.scale")
        self.assertIsNotNone(run.sensitivities)
        run.save(self.folder / "loads.h5")
        again = condyle.open_run(self.folder / "loads.h5")
        self.assertEqual(again.swept, "compression.scale")
        np.testing.assert_array_equal(again.values, [1, 1.5, 2])
        with self.assertRaisesRegex(condyle.InputError, 'vary = "nothing"'):
            condyle.sweep(knees.phantom(), [1], vary="nothing")
        scene = knees.spring()
        scene.sweep = None
        with self.assertRaisesRegex(condyle.InputError, r"\[sweep\] is missing"):
            condyle.sweep(scene, [1])
        self.assertEqual(len(condyle.sweep(scene, [1], vary="pull.scale")), 1)


if __name__ == "__main__":
    unittest.main()
