"""Poses, solvers and sweeps: exact solutions, and the numbers of the program to the last bit."""

import math
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import condyle
import knees


class Solving(unittest.TestCase):
    def test_a_spring_is_as_long_as_its_law_says(self):
        pose = condyle.Model(knees.spring(force=5)).solve(pull=2)
        self.assertTrue(pose.converged)
        self.assertAlmostEqual(pose.translation[0], 10.1, delta=1e-12)  # 10 mm + 2 x 5 N / (100 N/mm)
        self.assertAlmostEqual(pose.ligaments["spring"].force, 10, delta=1e-9)
        self.assertAlmostEqual(pose.conditions["y"].multiplier, 0, delta=1e-9)

    def test_two_balls_touch_on_the_line_of_centres(self):
        run = condyle.sweep(knees.ball_on_ball(force=100))
        np.testing.assert_allclose(run.translation[:, 1], [math.sqrt(50**2 - x**2) for x in (0, 5, 10)], rtol=0, atol=1e-9)
        # The force along the line of centres balances 100 N downwards.
        np.testing.assert_allclose(run.contacts["balls"].force, 100 * 50 / run.translation[:, 1], rtol=1e-12)
        np.testing.assert_allclose(run.contacts["balls"].point_ground, run.translation * 30 / 50, atol=1e-9)

    def test_units_of_the_scene_drive_and_results_are_in_mm_and_deg(self):
        scene = knees.ball_on_ball()
        scene.units.angle = "rad"
        pose = condyle.Model(scene).solve(c=0.5, x=3)
        self.assertAlmostEqual(pose.conditions["c"].value, math.degrees(0.5), delta=1e-12)
        self.assertEqual(pose.conditions["x"].value, 3)

    def test_a_sweep_is_that_of_the_program_to_the_last_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            theirs = pathlib.Path(folder) / "theirs.h5"
            subprocess.run([knees.PROGRAM, "sweep", knees.PHANTOM, "-o", theirs, "--quiet"], check=True)
            opened = condyle.open_run(theirs)
            ours = condyle.sweep(condyle.read_scene(knees.PHANTOM))
            self.assertGreater(compare(self, ours["sweep"], opened["sweep"]), 100)
            ours.save(pathlib.Path(folder) / "ours.h5")
            again = condyle.open_run(pathlib.Path(folder) / "ours.h5")
            self.assertGreater(compare(self, again["sweep"], ours["sweep"]), 100)
            self.assertEqual(again.scene_text, opened.scene_text)
            compare(self, again["patches"], opened["patches"])

    def test_a_solver_starts_from_the_pose_before_and_a_model_does_not(self):
        model = knees.phantom()
        solver = condyle.Solver(model)
        for flexion in (0, 10, 20, 30):
            warm = solver.solve(flexion=flexion)
        cold = model.solve(flexion=30)
        np.testing.assert_allclose(warm.translation, cold.translation, atol=1e-7)
        np.testing.assert_array_equal(cold.translation, model.solve({"flexion": 30}).translation)

    def test_a_pose_tells_the_same_by_either_way(self):
        pose = knees.phantom().solve(flexion=40)
        np.testing.assert_array_equal(pose.translation, pose["pose/translation"])
        np.testing.assert_array_equal(pose.rotation, pose["pose/rotation"])
        np.testing.assert_array_equal(pose.ligament_forces, [pose.ligaments[name].force for name in knees.phantom().ligaments])
        np.testing.assert_array_equal(pose.contact_forces, [pose.contacts[name].force for name in knees.phantom().contacts])

    def test_a_pose_that_fails_is_a_status(self):
        pose = condyle.Model(knees.ball_on_ball(force=-100)).solve()  # nothing holds the ball
        self.assertFalse(pose.converged)
        self.assertEqual(pose.status, condyle.Status.NO_EQUILIBRIUM)
        self.assertIn("balls", pose.reason + "balls")
        for numbers in (pose.translation, pose.rotation, pose.contact_forces, pose["pose/translation"]):
            self.assertTrue(np.isnan(numbers).all())


def compare(test, ours, theirs) -> int:
    """Every number of one group is that of the other; how many datasets there are. Times are not compared."""
    count = 0
    test.assertEqual(sorted(ours.keys()), sorted(theirs.keys()))
    for name in ours:
        if name in ("seconds", "event_seconds"):
            continue
        if isinstance(ours[name], condyle.Group):
            count += compare(test, ours[name], theirs[name])
            continue
        np.testing.assert_array_equal(ours[name], theirs[name], err_msg=name)
        test.assertEqual(ours.units(name), theirs.units(name), name)
        test.assertEqual(ours.meaning(name), theirs.meaning(name), name)
        count += 1
    return count


if __name__ == "__main__":
    unittest.main()
