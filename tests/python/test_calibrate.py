"""Calibrations: a knee that is known is found again, the program's numbers, files, what interrupts, bad input."""

import os
import signal
import threading
import unittest

import numpy as np

import condyle
import knees
from condyle import Calibrate, CalibrateLoad, CalibrateParameter
from same_numbers import expect_same
from test_studies import DATA, Folder

TIMES = ["seconds"]


class Calibrations(Folder):
    def knee(self, truth=1.5):
        """The drawer knee, and rows that the same knee with an aACL `truth` times as stiff and an aPCL of half its
        stiffness would give."""
        scene = condyle.read_scene(DATA / "wismans-type" / "drawer.toml")
        solver = condyle.Solver(condyle.Model(scene))
        solver.set({"aACL.stiffness": truth * scene.ligaments["aACL"].stiffness,
                    "aPCL.stiffness": scene.ligaments["aPCL"].stiffness / 2})
        rows = ["test,flexion,load,level,coordinate,value,sd"]
        for flexion in (0, 20, 40):
            solver.reset()
            for level in (0, 60, 100, -60, -100):
                for turned in np.linspace(0, flexion, 1 + flexion // 5)[-2:]:
                    joint = solver.solve({"flexion": turned, "drawer.scale": level / 100}).joint
                for name in ("anterior_drawer", "internal_rotation"):
                    rows.append(f"ap{flexion},{flexion},drawer,{level},{name},{joint[name]:.12g},0.2")
        table = self.folder / "table.csv"
        table.write_text("\n".join(rows) + "\n")
        scene.laxity = None
        scene.loads["drawer"].scale = 0
        scene.calibrate = Calibrate(
            measurements=table, starts=1, samples=6, load=[CalibrateLoad("drawer", load="drawer")],
            parameter=[CalibrateParameter(of=["aACL", "aPCL"], what="stiffness", prior_sd=2)])
        return scene

    def test_a_known_knee_is_found_again_with_the_program_s_bits(self):
        scene = self.knee()
        told = []
        run = condyle.calibrate(scene, progress=lambda stage, done, total: told.append((stage, done, total)))
        found = run.calibration
        self.assertEqual(found.parameters.name, ("aACL.stiffness", "aPCL.stiffness"))
        np.testing.assert_allclose(found.parameters.mean, np.log([1.5, 0.5]), atol=2e-2)
        self.assertEqual(run.posterior.samples.shape, (6, 2))
        self.assertEqual(found.figures.converged[0], 1)
        self.assertTrue(all(0 <= done <= total for _, done, total in told))
        self.assertGreater(len({stage for stage, _, _ in told}), 2)

        theirs = self.of_program("calibrate", scene)
        expect_same(self, found, theirs.calibration, but=TIMES)
        expect_same(self, run.posterior, theirs.posterior)
        expect_same(self, condyle.calibrate(scene, threads=2).calibration, found, but=TIMES)

        fitted = condyle.fitted_scene(run)
        change = fitted.ligaments["aACL"].stiffness / scene.ligaments["aACL"].stiffness
        self.assertAlmostEqual(np.log(change), found.parameters.mean[0], places=5)
        self.assertEqual(condyle.fitted_scene(theirs).ligaments, fitted.ligaments)
        condyle.Model(fitted)

    def test_results_are_written_and_gone_on_from(self):
        scene, output = self.knee(), self.folder / "fit.h5"
        journal = self.folder / "fit.h5.journal"

        class Enough(Exception):
            pass

        def stop(stage, done, total):
            if journal.exists() and journal.stat().st_size > 0:
                raise Enough
        with self.assertRaises(Enough):
            condyle.calibrate(scene, output=output, progress=stop)
        self.assertFalse(output.exists())
        self.assertTrue(journal.exists())
        run = condyle.calibrate(scene, output=output, resume=True, samples=0, starts=1, seed=3)
        self.assertFalse(journal.exists())
        expect_same(self, condyle.open_run(output).calibration, run.calibration)
        self.assertIsNone(run.posterior)
        with self.assertRaisesRegex(condyle.InputError, "table.csv: expected a name that ends in .h5"):
            condyle.calibrate(scene, output=scene.calibrate.measurements)
        with self.assertRaisesRegex(condyle.InputError, "expected a name that ends in .h5"):
            condyle.calibrate(scene, output=self.folder / "fit.toml")
        self.assertIn("anterior_drawer", (self.folder / "table.csv").read_text())

    def test_ctrl_c_ends_it(self):
        scene = self.knee()
        begun = threading.Event()
        timer = threading.Thread(target=lambda: (begun.wait(), os.kill(os.getpid(), signal.SIGINT)))
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                condyle.calibrate(scene, starts=1000, progress=lambda *_: begun.set())
        finally:
            begun.set()
            timer.join()

    def test_bad_input(self):
        with self.assertRaisesRegex(condyle.InputError, r"\[calibrate\] is missing"):
            condyle.calibrate(knees.ball_on_ball())
        scene = self.knee()
        for wrong, error, words in (({"starts": 0}, condyle.InputError, "starts = 0, expected"),
                                    ({"samples": -1}, condyle.InputError, "samples = -1"),
                                    ({"seed": -1}, condyle.InputError, "seed = -1"), ({"seed": 1.5}, TypeError, "seed: float"),
                                    ({"threads": 0}, condyle.InputError, "threads = 0"),
                                    ({"output": 3}, TypeError, "output: int"),
                                    ({"output": self.folder / "no" / "x.h5"}, condyle.InputError, "no"),
                                    ({"resume": True}, condyle.InputError, "resume = True"),
                                    ({"progress": "p"}, TypeError, "progress")):
            with self.assertRaisesRegex(error, words):
                condyle.calibrate(scene, **wrong)
        for nothing in (None, condyle.sweep(knees.ball_on_ball())):
            with self.assertRaisesRegex((TypeError, condyle.InputError), "run: "):
                condyle.fitted_scene(nothing)
        table = self.folder / "table.csv"
        table.write_text(table.read_text().replace("ap20,20", "ap20,x"))
        with self.assertRaisesRegex(condyle.InputError, "table.csv:12"):
            condyle.calibrate(scene)
        table.unlink()
        with self.assertRaisesRegex(condyle.InputError, "table.csv"):
            condyle.calibrate(scene)


if __name__ == "__main__":
    unittest.main()
