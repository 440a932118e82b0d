"""Studies: the numbers of the program's files, samples one by one, files that go, what interrupts, bad input."""

import gc
import os
import pathlib
import signal
import subprocess
import threading
import unittest
import unittest.mock

import numpy as np

import condyle
import knees
from same_numbers import expect_same, program
from test_studies import DATA, Folder
from test_threads import in_threads

KNEE = DATA / "wismans-type" / "knee.toml"


def text(samples=128, design="monte-carlo", knee=KNEE, more=""):
    return f"""
title = "Two strains"
specimens = "{knee}"
design = "{design}"
samples = {samples}
outputs = ["joint", "aACL.force"]
{more}
[[vary]]
what = "slack_length"
of = ["aACL", "LCL"]
sd = 0.5
"""


class Studies(Folder):
    def test_numbers_are_those_of_the_program(self):
        ours = condyle.study(text(design="saltelli", samples=16), threads=2)
        path = self.folder / "study.toml"
        path.write_text(text(design="saltelli", samples=16))
        theirs = condyle.open_study(program("study", path, self.folder / "study.h5"))
        for group in ("samples", "outputs", "bands", "indices", "failures", "sweep"):
            expect_same(self, ours[group], theirs[group])
        np.testing.assert_array_equal(ours.theta, theirs.theta)
        self.assertEqual((len(ours), ours.design, ours.swept, ours.knees), (64, "saltelli", "flexion", ("knee",)))
        self.assertEqual(ours.theta.shape, (64, 2))
        poses = len(ours.values)
        self.assertEqual(ours.indices["aACL.force"].total.shape, (2, poses, 3))
        self.assertEqual(ours.outputs["aACL.force"].shape, (64, poses))
        self.assertEqual(ours.parameters.name, ("aACL.slack_length", "LCL.slack_length"))
        self.assertEqual(ours["bands/aACL.force"].units("mean"), "N")
        self.assertEqual(ours.lines, theirs.lines)
        self.assertIn("Two strains", repr(ours))

    def test_bands_are_of_the_samples_and_a_sample_is_a_knee(self):
        study = condyle.study(text())
        force = study["outputs/aACL.force"]
        np.testing.assert_allclose(study.bands["aACL.force"].mean, np.nanmean(force, axis=0), rtol=1e-12)
        scene = condyle.read_scene(KNEE)
        for name, change in zip(("aACL", "LCL"), study.theta[7]):
            scene.ligaments[name].slack_length += change
        sweep = condyle.sweep(scene)
        np.testing.assert_allclose(sweep.ligaments["aACL"].force, force[7], atol=1e-6)
        self.assertEqual(study.failures.poses[0], force.size)

    def test_a_study_is_in_no_file_and_reads_samples_when_asked(self):
        with unittest.mock.patch.dict(os.environ, TMPDIR=str(self.folder)):
            study = condyle.study(text())
        self.assertEqual(list(self.folder.iterdir()), [])
        force = study["outputs/aACL.force"]
        self.assertFalse(force.flags.writeable)
        expected = force.copy()
        np.testing.assert_array_equal(study.outputs["aACL.force"], expected)
        self.assertIs(type(study["outputs"]), condyle.Group)
        with self.assertRaisesRegex(KeyError, 'did you mean "aACL.force"'):
            study["outputs/aACL.forces"]
        with self.assertRaisesRegex(KeyError, 'did you mean "bands"'):
            study["band"]
        for place in ("", "/", "outputs/", "/outputs", "outputs//", "outputs/aACL.force/more"):
            try:
                study[place]
            except KeyError:
                pass
        del study
        gc.collect()
        np.testing.assert_array_equal(force, expected)

    def test_a_file_may_go_while_its_study_stays(self):
        path = self.folder / "study.h5"
        study = condyle.study(text(), output=path)
        opened = condyle.open_study(path)
        path.unlink()
        expect_same(self, opened.outputs, study.outputs)

    def test_samples_and_seed_of_ones_own(self):
        few = condyle.study(text(), samples=20, seed=5)
        self.assertEqual(len(few), 20)
        self.assertTrue((few.theta != condyle.study(text(samples=20)).theta).any())
        np.testing.assert_array_equal(few.theta, condyle.study(text(), samples=20, seed=5, threads=3).theta)

    def test_threads_of_python(self):
        alone = condyle.study(text())
        for study in in_threads(3, lambda i: condyle.study(text(), threads=1)):
            expect_same(self, study["outputs"], alone["outputs"])

    def test_what_stops_it_leaves_what_is_done(self):
        output = self.folder / "study.h5"
        journal = pathlib.Path(str(output) + ".journal")
        told = []

        def stop(done, total):
            told.append((done, total))
            if done:
                raise LookupError("enough")
        with self.assertRaisesRegex(LookupError, "enough"):
            condyle.study(text(samples=640), output=output, progress=stop, threads=1)
        self.assertEqual(told[-1][1], 640)
        self.assertTrue(list(journal.glob("*.chunks")))
        self.assertFalse(output.exists())
        told.clear()
        study = condyle.study(text(samples=640), output=output, resume=True, progress=lambda *is_done: told.append(is_done))
        self.assertLess(told[-1][1], 640)
        self.assertFalse(journal.exists())
        expect_same(self, study["outputs"], condyle.study(text(samples=640))["outputs"])
        again = condyle.study(text(samples=640), output=output, resume=True, progress=stop)
        self.assertEqual(len(again), 640)
        subprocess.run([knees.PROGRAM, "plot", output, "-o", self.folder / "plots"], check=True, capture_output=True)

    def test_ctrl_c_ends_it(self):
        begun = threading.Event()
        timer = threading.Thread(target=lambda: (begun.wait(), os.kill(os.getpid(), signal.SIGINT)))
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                condyle.study(text(samples=1000000), progress=lambda *_: begun.set())
        finally:
            begun.set()
            timer.join()

    def test_several_knees(self):
        other = self.folder / "other.toml"
        scene = condyle.read_scene(KNEE)
        scene.ligaments["aACL"].stiffness *= 1.2
        scene.save(other)
        study = condyle.study(text(samples=8).replace(f'"{KNEE}"', f'["{KNEE}", "other.toml"]'), folder=self.folder)
        self.assertEqual(study.knees, ("knee", "other"))
        self.assertEqual(len(study), 16)
        first = study["knees/knee/bands/aACL.force/mean"]
        np.testing.assert_allclose(first, np.nanmean(study["outputs/aACL.force"][:8], axis=0), rtol=1e-12)

    def test_bad_input(self):
        for wrong, error, words in (({"samples": 0}, condyle.InputError, "samples = 0, expected"),
                                    ({"samples": 2.5}, TypeError, "samples: float"),
                                    ({"seed": -1}, condyle.InputError, "seed = -1"),
                                    ({"threads": 0}, condyle.InputError, "threads = 0"),
                                    ({"output": 3}, TypeError, "output: int"), ({"folder": 3}, TypeError, "folder: int"),
                                    ({"output": self.folder / "no" / "x.h5"}, condyle.InputError, "no"),
                                    ({"resume": True}, condyle.InputError, "resume = True"),
                                    ({"progress": "p"}, TypeError, "progress")):
            with self.assertRaisesRegex(error, words):
                condyle.study(text(), **wrong)
        with self.assertRaisesRegex(condyle.InputError, "samples = 5: the design of"):
            condyle.study(text(design="grid").replace("samples = 128", ""), samples=5)
        for unusable in (3, None, []):
            with self.assertRaisesRegex(TypeError, "study: "):
                condyle.study(unusable)
            with self.assertRaisesRegex(TypeError, "path: "):
                condyle.open_study(unusable)
        with self.assertRaisesRegex(condyle.InputError, "missing.toml"):
            condyle.study(self.folder / "missing.toml")
        with self.assertRaisesRegex(condyle.InputError, "<text>:5: .*samples"):
            condyle.study(text(samples=-1))
        with self.assertRaisesRegex(condyle.InputError, "is a scene"):
            condyle.study(KNEE)

    def test_a_file_of_another_kind_is_no_output(self):
        other = self.folder / "other.toml"
        knees.ball_on_ball().save(other)
        before = other.read_bytes()
        for name in (other, self.folder / "femur.STL", self.folder / "table.csv"):
            with self.assertRaisesRegex(condyle.InputError, "expected a name that ends in .h5"):
                condyle.study(text(samples=8), output=name)
        self.assertEqual(other.read_bytes(), before)

    def test_a_file_that_is_written_into_is_not_read_on(self):
        path, other = self.folder / "a.h5", self.folder / "b.h5"
        condyle.study(text(samples=8), output=path)
        condyle.study(text(samples=16), output=other)
        study, replaced = condyle.open_study(path), condyle.open_study(other)
        with open(path, "r+b") as file:
            file.truncate(3000)
        with self.assertRaisesRegex(condyle.InputError, "a.h5: has been written into"):
            study["outputs/aACL.force"]
        other.unlink()  # what is held open is as it was
        self.assertEqual(replaced["outputs/aACL.force"].shape[0], 16)

    def test_files_that_are_no_studies(self):
        run, cut = self.folder / "run.h5", self.folder / "cut.h5"
        condyle.sweep(knees.ball_on_ball()).save(run)
        condyle.study(text(samples=8), output=cut)
        with self.assertRaisesRegex(condyle.InputError, "holds a study"):
            condyle.open_run(cut)
        cut.write_bytes(cut.read_bytes()[:9000])
        for path in (run, cut, self.folder, self.folder / "missing.h5"):
            with self.assertRaisesRegex(condyle.InputError, str(path)):
                condyle.open_study(path)


if __name__ == "__main__":
    unittest.main()
