"""Laws and loads of one's own, in Python and in C."""

import ctypes
import gc
import math
import threading
import unittest
import weakref

import numpy as np

import condyle
import knees

LAW = ctypes.CFUNCTYPE(None, ctypes.c_double, ctypes.POINTER(ctypes.c_double), ctypes.c_void_p)
LOAD = ctypes.CFUNCTYPE(None, ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_double), ctypes.c_void_p)


def cubic(length):
    """f = 2 (L - 10)^3 beyond 10 mm."""
    stretch = max(length - 10, 0)
    return 2 * stretch**3, 6 * stretch**2, 0.5 * stretch**4


@LAW
def cubic_in_c(length, out, user):
    out[0], out[1], out[2] = cubic(length)


def ctypes_address(function):
    return ctypes.cast(function, ctypes.c_void_p).value


class Laws(unittest.TestCase):
    def test_a_law_in_python_holds_the_load(self):
        model = condyle.Model(knees.spring(law=cubic, force=16))
        pose = model.solve()
        self.assertTrue(pose.converged, pose.reason)
        self.assertAlmostEqual(pose.translation[0], 12, delta=1e-9)  # 2 x 2^3 = 16 N

    def test_a_c_function_does_the_same_to_the_last_bit(self):
        capsule = ctypes.pythonapi.PyCapsule_New
        capsule.restype, capsule.argtypes = ctypes.py_object, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
        in_capsule = capsule(ctypes.cast(cubic_in_c, ctypes.c_void_p), None, None)
        lengths = []
        for law in (cubic, cubic_in_c, in_capsule):
            run = condyle.sweep(knees.spring(law=law, force=16), np.linspace(0.1, 3, 30))
            self.assertTrue(run.converged.all())
            lengths.append(run.translation[:, 0])
        np.testing.assert_array_equal(lengths[0], lengths[1])
        np.testing.assert_array_equal(lengths[0], lengths[2])
        np.testing.assert_allclose(lengths[0], 10 + np.cbrt(8 * np.linspace(0.1, 3, 30)), rtol=1e-12)

    def test_a_law_as_a_function_is_that_of_a_file(self):
        def toe_linear(length, k=5000.0, l0=20.0, toe=0.06):
            strain = length / l0 - 1
            if strain <= 0:
                return 0, 0, 0
            if strain >= toe:
                return k * (strain - toe / 2), k / l0, k * (strain * (strain - toe) / 2 + toe * toe / 6) * l0
            return k * strain**2 / (2 * toe), k / l0 * strain / toe, k * strain**3 / (6 * toe) * l0

        scene = condyle.read_scene(knees.PHANTOM)
        ligament = scene.ligaments["aACL"]
        ligament.law, ligament.slack_length, ligament.reference_strain = "toe-linear", 20.0, None
        ligament.stiffness, ligament.transition_strain = 5000.0, 0.06
        surfaces = condyle.fit(scene)
        theirs = condyle.Model(scene, surfaces).solve(flexion=20)
        scene.ligaments["aACL"] = condyle.Ligament("aACL", ends=ligament.ends, law=toe_linear)
        ours = condyle.Model(scene, surfaces).solve(flexion=20)
        np.testing.assert_allclose(ours.translation, theirs.translation, rtol=0, atol=1e-9)
        self.assertAlmostEqual(ours.ligaments["aACL"].force, theirs.ligaments["aACL"].force, delta=1e-7)

    def test_what_a_law_raises_comes_through_and_the_solver_goes_on(self):
        calls = []
        broken = []

        def law(length):
            calls.append(length)
            if broken and len(calls) > broken[0]:
                raise ZeroDivisionError("in the middle of Newton")
            return cubic(length)

        model = condyle.Model(knees.spring(law=law, force=16))
        solver = condyle.Solver(model)
        expected = solver.solve().translation[0]
        for allowed in (0, 1, 2, 3, 5, 8, 13):
            calls.clear()
            broken[:] = [allowed]
            for broken_call in (solver.solve, model.solve, lambda: condyle.sweep(model)):
                calls.clear()
                with self.assertRaisesRegex(ZeroDivisionError, "in the middle of Newton"):
                    for pull in range(1, 9):
                        broken_call() if broken_call is not solver.solve else solver.solve(pull=pull)
            broken.clear()
            self.assertAlmostEqual(solver.solve().translation[0], expected, delta=1e-9)

    def test_results_of_a_wrong_shape_are_named(self):
        for result, error, expected in (((1, 2), TypeError, "law returned"), (None, TypeError, "law returned"),
                                        ("abc", TypeError, "law returned"), ((1, 2, float("nan")), condyle.InputError, "nan"),
                                        ((1, 2, 3, 4), TypeError, "3 numbers"), ((float("inf"), 0, 0), condyle.InputError, "inf")):
            with self.assertRaisesRegex(error, r'\[\[ligament\]\] "spring": law.*' + expected if expected != "law returned"
                                        else '"spring": law returned'):
                condyle.Model(knees.spring(law=lambda length, result=result: result)).solve()

        @LAW
        def bad(length, out, user):
            out[0] = out[1] = out[2] = float("nan")
        with self.assertRaisesRegex(condyle.InputError, '"spring": law returned -?nan at length'):
            condyle.Model(knees.spring(law=bad)).solve()
        with self.assertRaisesRegex(TypeError, '"spring": law: int, expected a function'):
            condyle.Model(knees.spring(law=3))

    def test_a_c_function_of_another_declaration_is_refused(self):
        for other in (ctypes.CDLL(None).abs, LOAD(lambda pose, out, user: None),
                      ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(lambda x: x)):
            with self.assertRaisesRegex(TypeError, "ctypes function of another declaration"):
                condyle.Model(knees.spring(law=other))

    def test_a_function_of_numba_is_known_by_its_address(self):
        class Compiled:  # as numba.cfunc returns
            ctypes = cubic_in_c
            address = ctypes_address(cubic_in_c)

            def __call__(self, length):
                raise AssertionError("asked in Python")
        pose = condyle.Model(knees.spring(law=Compiled(), force=16)).solve()
        self.assertAlmostEqual(pose.translation[0], 12, delta=1e-9)

    def test_numbers_of_another_law_are_refused_beside_a_function(self):
        for numbers, said in (({"law": "toe-linear", "stiffness": 1000, "slack_length": 10}, "stiffness = 1000"),
                              ({"law": "polynomial", "coefficients": [0.0, 1.0]}, r"coefficients = \[0.0, 1.0\]")):
            scene = knees.spring(**numbers)
            scene.ligaments["spring"].law = cubic
            with self.assertRaisesRegex(condyle.InputError, f"'spring': law is a function, expected no {said} beside it"):
                condyle.Model(scene)
            for key in numbers.keys() - {"law"}:
                delattr(scene.ligaments["spring"], key)
            self.assertTrue(condyle.Model(scene).solve().converged)

    def test_no_file_holds_a_function(self):
        scene = knees.spring(law=cubic)
        with self.assertRaisesRegex(condyle.InputError, "law is a function"):
            scene.to_toml()
        run = condyle.sweep(scene)
        with self.assertRaisesRegex(condyle.InputError, "law is a function"):
            run.save("never.h5")

    def test_a_law_may_not_solve_with_the_solver_that_asks_it(self):
        told = []

        def law(length):
            try:
                solver.solve()
            except RuntimeError as error:
                told.append(str(error))
            return cubic(length)

        solver = condyle.Solver(condyle.Model(knees.spring(law=law)))
        self.assertTrue(solver.solve().converged)
        self.assertIn("one Solver for each thread", told[0])

    def test_several_threads_call_one_law_in_python(self):
        model = condyle.Model(knees.spring(law=cubic, force=16))
        found = []

        def work():
            found.append([model.solve(pull=pull).translation[0] for pull in (1, 2, 3)])

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [found[0]] * 4)

    def test_a_law_lives_as_long_as_its_model_and_no_longer(self):
        class Law:
            def __call__(self, length):
                return cubic(length)
        law = Law()
        alive = weakref.ref(law)
        model = condyle.Model(knees.spring(law=law))
        del law
        gc.collect()
        self.assertIsNotNone(alive())
        model.solve()
        del model
        gc.collect()
        self.assertIsNone(alive())


class Loads(unittest.TestCase):
    """A spring to a point, as a load: energy k |a - c|^2 / 2, so the body with its element finds a place between."""

    K, C = 3.0, np.array([30.0, 0, 0])

    def pull(self, translation, rotation):
        return self.K * (self.C - translation), np.zeros(3)

    def check(self, function):
        model = condyle.Model(self.scene(function))
        pose = model.solve()
        self.assertTrue(pose.converged, pose.reason)
        # 100 (x - 10) = 3 (30 - x)
        self.assertAlmostEqual(pose.translation[0], (1000 + 90) / 103, delta=1e-9)
        return pose

    def scene(self, function):
        scene = knees.spring()
        scene.loads = [condyle.Load("pull", body="weight", function=function)]
        scene.sweep = None
        return scene

    def test_with_derivatives_without_and_in_c_it_is_the_same(self):
        derivatives = np.zeros((6, 6))
        derivatives[:3, :3] = -self.K * np.eye(3)

        @LOAD
        def in_c(pose, out, user):
            for i in range(42):
                out[i] = 0
            for i in range(3):
                out[i] = self.K * (self.C[i] - pose[i])
                out[6 + 7 * i] = -self.K

        exact = self.check(lambda a, R: (*self.pull(a, R), derivatives))
        self.check(self.pull)
        np.testing.assert_array_equal(self.check(in_c).translation, exact.translation)

    def test_a_load_is_told_about_the_origin_of_the_file_whatever_the_model_uses(self):
        # A dead force at a point, as the scene has it and as a function, on a body that turns freely about x.
        scene = condyle.read_scene(knees.PHANTOM)
        at, force = np.array([5.0, -40, 3]), np.array([0.0, 60, 20])
        scene.loads.append(condyle.Load("extra", body="tibia", kind="force", vector=force, at=at))
        surfaces = condyle.fit(scene)
        theirs = condyle.Model(scene, surfaces).solve(flexion=25)
        scene.loads[-1] = condyle.Load("extra", body="tibia", function=lambda a, R: (force, np.cross(R @ at, force)))
        ours = condyle.Model(scene, surfaces).solve(flexion=25)
        self.assertTrue(theirs.converged and ours.converged)
        np.testing.assert_allclose(ours.translation, theirs.translation, atol=1e-6)
        self.assertGreater(np.abs(theirs.translation - condyle.Model(condyle.read_scene(knees.PHANTOM), surfaces)
                                  .solve(flexion=25).translation).max(), 0.01)

    def test_derivatives_that_do_not_know_them_are_refused(self):
        scene = condyle.read_scene(knees.PHANTOM)
        scene.loads.append(condyle.Load("own", body="tibia", function=lambda a, R: (np.zeros(3), np.zeros(3))))
        with self.assertRaisesRegex(condyle.InputError, '"own": function: is a function, expected none: derivatives'):
            condyle.sweep(scene, [0, 1], sensitivities=["aACL.reference_strain"])

    def test_wrong_results_are_named(self):
        for result, error in ((None, TypeError), ((1, 2), TypeError), ((np.zeros(3), np.zeros(2)), TypeError),
                              ((np.zeros(3), np.full(3, math.nan)), condyle.InputError)):
            with self.assertRaisesRegex(error, r'\[\[load\]\] "pull": function'):
                condyle.Model(self.scene(lambda a, R, result=result: result)).solve()


if __name__ == "__main__":
    unittest.main()
