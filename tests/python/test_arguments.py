"""Whatever is given, the interpreter lives and an exception names the argument."""

import unittest

import numpy as np

import condyle
import knees

try:
    from hypothesis import HealthCheck, given, settings
    from hypothesis import strategies as st
except ImportError:
    st = None

EXPECTED = (condyle.InputError, TypeError, KeyError, IndexError, OverflowError, AttributeError)


class Arguments(unittest.TestCase):
    def test_numbers_that_are_none_are_named(self):
        model, solver = knees.phantom(), condyle.Solver(knees.phantom())
        for value, error in ((float("nan"), condyle.InputError), (float("inf"), condyle.InputError), (None, TypeError),
                             ("30", TypeError), ([30], TypeError), (1j, TypeError), (10**400, (TypeError, OverflowError)),
                             (np.array([1, 2]), TypeError), (object(), TypeError)):
            for call in (model.solve, solver.solve):
                with self.assertRaisesRegex(error, "flexion"):
                    call(flexion=value)
                with self.assertRaisesRegex(error, "flexion"):
                    call({"flexion": value})
            if not isinstance(value, (list, np.ndarray)):
                with self.assertRaisesRegex(error, "aACL.stiffness"):
                    solver.set("aACL.stiffness", value)
        for value in (np.float32(30), np.int64(30), True, np.array(30.0)):
            self.assertTrue(model.solve(flexion=value).converged)
        for drive in (3, "flexion", ["flexion"], {3: 4}):
            with self.assertRaisesRegex(TypeError, "drive"):
                solver.solve(drive)
        with self.assertRaisesRegex(TypeError, 'did you mean "flexion"'):
            solver.solve(flexio=3)

    def test_an_unknown_keyword_is_told_by_its_name_alone(self):
        for function in (condyle.calibrate, condyle.compare, condyle.fit, condyle.laxity, condyle.simulate, condyle.study,
                         condyle.sweep, condyle.open_run, condyle.open_study, condyle.Model, condyle.Solver):
            with self.assertRaisesRegex(TypeError, rf"^{function.__name__}\(\) got an unexpected keyword argument 'foo'$"):
                function(None, foo=1)

    def test_a_number_that_is_given_twice_is_refused(self):
        solver = condyle.Solver(knees.phantom())
        for solve in (solver.solve, knees.phantom().solve):
            with self.assertRaisesRegex(TypeError, "flexion is given twice"):
                solve({"flexion": 10}, flexion=20)
            self.assertTrue(solve({"compression.scale": 1.1}, flexion=20).converged)
        with self.assertRaisesRegex(TypeError, "value: expected none beside a dict"):
            solver.set({"aACL.stiffness": 1000}, 2000)

    def test_a_solver_is_not_swept_and_says_what_is(self):
        with self.assertRaisesRegex(TypeError, "condyle.Solver, expected a condyle.Scene or a condyle.Model"):
            condyle.sweep(condyle.Solver(knees.phantom()), [0])

    def test_surfaces_of_another_fit_are_refused(self):
        scene = knees.ball_on_ball()
        surfaces = condyle.fit(scene)
        self.assertTrue(condyle.Model(scene, surfaces).solve(x=1).converged)
        scene.surfaces[0].radius = 25
        with self.assertRaisesRegex(condyle.InputError, "fitted for another scene"):
            condyle.Model(scene, surfaces)

    def test_surfaces_serve_contacts_of_the_law_they_were_fitted_for(self):
        scene = condyle.read_scene(knees.PHANTOM)
        rigid = condyle.fit(scene)
        for surface in scene.surfaces:
            surface.modulus, surface.poisson, surface.layer = 5, 0.45, 3
        for contact in scene.contacts:
            contact.law = "layer"
        with self.assertRaisesRegex(condyle.InputError, "fitted for another scene"):
            condyle.Model(scene, rigid)
        layered = condyle.fit(scene)
        condyle.Model(scene, layered)
        for surface in scene.surfaces:
            surface.layer = 25
        with self.assertRaisesRegex(condyle.InputError, "layer = 25, expected a thickness less"):
            condyle.Model(scene, layered)

    def test_values_are_those_that_a_scene_may_have(self):
        with self.assertRaisesRegex(condyle.InputError, "one turn"):
            condyle.sweep(knees.phantom(), [0, 720])
        scene = knees.spring()
        scene.sweep.path = "arc length"
        with self.assertRaisesRegex(condyle.InputError, "go one way"):
            condyle.sweep(scene, [0, 5, 0])

    def test_values_of_a_sweep_are_named(self):
        for values, error in (([], condyle.InputError), (3, condyle.InputError), ([[1, 2]], condyle.InputError),
                              ([1, float("nan")], condyle.InputError), (["1"], TypeError), ("123", TypeError), ([None], TypeError),
                              ([1j], TypeError), (np.zeros(1000001), condyle.InputError), (np.zeros((0, 3)), condyle.InputError),
                              ([[1], [2, 3]], TypeError), (object(), TypeError), (b"12", TypeError)):
            with self.assertRaisesRegex(error, "values"):
                condyle.sweep(knees.phantom(), values)
        run = condyle.sweep(knees.phantom(), np.arange(6)[::-2])  # neither contiguous nor float
        np.testing.assert_allclose(run.values, [5, 3, 1], rtol=1e-15)

    def test_numbers_of_a_solver_are_named_and_all_are_set_or_none(self):
        solver = condyle.Solver(knees.phantom())
        before = solver.get("aACL.stiffness")
        for numbers, error, expected in (
                ({"aACL.stiffness": 1.0, "aACL.slack_length": -3}, condyle.InputError, "aACL.slack_length = -3"),
                ({"aACL.stiffness": 1.0, "aACL.slak": 3}, condyle.InputError, "aACL.slak"),
                ({"aACL.stiffness": 1.0, "aACL.insertion.tibia": [1, 2]}, condyle.InputError, "insertion.tibia: 2 numbers, expected 3"),
                ({"aACL.stiffness": [1.0, 2]}, condyle.InputError, "stiffness: 2 numbers, expected 1"),
                ({"aACL.reference_strain": -1}, condyle.InputError, "reference_strain = -1"),
                ({"medial condyle.shift": [0, 0, 1]}, condyle.InputError, "model's own"),
                ({3: 4}, TypeError, "names of numbers"), (3, TypeError, "numbers: expected")):
            with self.assertRaisesRegex(error, expected):
                solver.set(numbers)
            self.assertEqual(solver.get("aACL.stiffness"), before)
        solver.set("aACL.stiffness", 1234.5)
        solver.set("aACL.insertion.tibia", np.array([10.0, -20, 3]))
        self.assertEqual(solver.get("aACL.stiffness"), 1234.5)
        np.testing.assert_allclose(solver.get("aACL.insertion.tibia"), [10, -20, 3], atol=1e-12)
        solver.set("*.stiffness", 2000)
        self.assertEqual(solver.get("pPCL.stiffness" if "pPCL" in knees.phantom().ligaments else "aACL.stiffness"), 2000)

    def test_numbers_that_are_set_act_as_those_of_a_scene(self):
        solver = condyle.Solver(condyle.Model(knees.spring(law="toe-linear", stiffness=1000, slack_length=10)))
        solver.set({"spring.stiffness": 2000, "spring.slack_length": 12.0, "pull.vector": [50, 0, 0], "pull.scale": 2})
        changed = knees.spring(law="toe-linear", stiffness=2000, slack_length=12)
        changed.loads[0].vector = [100, 0, 0]
        self.assertAlmostEqual(solver.solve().translation[0], condyle.Model(changed).solve().translation[0], delta=1e-12)

    def test_objects_without_init_hold_nothing_and_say_so(self):
        for kind in (condyle.Run, condyle.Pose, condyle.Group, condyle.Surfaces, condyle.Study):
            for make in (kind, lambda kind=kind: kind.__new__(kind), lambda kind=kind: type("Mine", (kind,), {})(),
                         lambda kind=kind: object.__new__(kind)):
                with self.assertRaises(TypeError):
                    make()
        for kind in (condyle.Model, condyle.Solver):
            empty = kind.__new__(kind)
            for name in dir(kind):
                if name.startswith("__"):
                    continue
                with self.assertRaises((RuntimeError, TypeError)):
                    getattr(empty, name)()
            for use in (repr, condyle.sweep, condyle.Solver, lambda thing: condyle.Model(knees.spring(), thing)):
                if not (kind is condyle.Solver and use is repr):
                    with self.assertRaises((RuntimeError, TypeError)):
                        use(empty)

    def test_surfaces_of_another_scene_are_refused(self):
        fitted = condyle.fit(condyle.read_scene(knees.PHANTOM))
        with self.assertRaisesRegex(condyle.InputError, "surfaces: fitted for another scene"):
            condyle.Model(knees.spring(), fitted)
        with self.assertRaisesRegex(TypeError, "surfaces: expected"):
            condyle.Model(knees.spring(), 3)


@unittest.skipIf(st is None, "hypothesis is not installed")
class Anything(unittest.TestCase):
    """Random arguments, the same each time: what is raised is an error of the input, and never the end of Python."""

    if st is not None:
        numbers = st.one_of(st.floats(), st.integers(), st.integers(-10, 10), st.floats(-100, 100))
        leaves = st.one_of(numbers, st.none(), st.booleans(), st.text(max_size=8), st.binary(max_size=4))
        things = st.recursive(leaves, lambda inner: st.one_of(st.lists(inner, max_size=4),
                                                               st.dictionaries(st.text(max_size=5), inner, max_size=3)), max_leaves=8)
        modest = settings(max_examples=60, derandomize=True, deadline=None, database=None,
                          suppress_health_check=list(HealthCheck))

        @given(st.dictionaries(st.sampled_from(["x", "c", "press", "press.scale", "", "no"]), st.one_of(numbers, things), max_size=3))
        @modest
        def test_drives(self, drive):
            try:
                pose = self.balls().solve(drive)
                self.assertIn(pose.status, list(condyle.Status))
            except EXPECTED:
                pass

        @given(st.one_of(st.lists(numbers, max_size=5), things))
        @modest
        def test_values(self, values):
            try:
                self.assertEqual(len(condyle.sweep(self.balls(), values)), 3 if values is None else len(values))
            except EXPECTED:
                pass

        @given(st.sampled_from(["bodies", "surfaces", "contacts", "ligaments", "wraps", "conditions", "loads", "sweep", "units", "joint",
                                "simulate", "laxity", "calibrate", "title"]), st.data())
        @modest
        def test_scenes(self, table, data):
            scene = knees.ball_on_ball()
            kind = condyle.Scene._tables.get(table)
            try:
                if kind is None or data.draw(st.booleans()):
                    setattr(scene, table, data.draw(self.things))
                else:
                    tables = getattr(scene, table)
                    kind = kind[0] if isinstance(kind, list) else kind
                    one = tables[0] if tables and isinstance(tables, list) else tables or kind()
                    setattr(one, data.draw(st.sampled_from(kind._keys)), data.draw(st.one_of(self.numbers, self.things)))
                    if not tables:
                        setattr(scene, table, [one] if isinstance(condyle.Scene._tables[table], list) else one)
                condyle.sweep(scene, [0, 1])
            except EXPECTED:
                pass

        @given(st.text(max_size=40))
        @modest
        def test_places(self, place):
            try:
                self.run_of_balls()[place]
            except EXPECTED:
                pass

        @given(st.one_of(things, st.tuples(numbers, numbers, numbers)))
        @modest
        def test_what_laws_return(self, result):
            try:
                condyle.Model(knees.spring(law=lambda length: result)).solve()
            except EXPECTED:
                pass

        @given(st.dictionaries(st.sampled_from(["spring.stiffness", "spring.slack_length", "spring.insertion.weight", "pull.vector",
                                                "pull.scale", "*.stiffness", "y.value", "spring.reference_strain"]),
                               st.one_of(numbers, st.lists(numbers, max_size=4)), max_size=3))
        @modest
        def test_numbers_of_solvers(self, numbers):
            solver = condyle.Solver(self.toe_linear())
            try:
                solver.set(numbers)
                solver.solve()
            except EXPECTED:
                pass

    _made = {}

    def balls(self):
        return self._made.setdefault("balls", condyle.Model(knees.ball_on_ball()))

    def run_of_balls(self):
        if "run" not in self._made:
            self._made["run"] = condyle.sweep(self.balls())
        return self._made["run"]

    def toe_linear(self):
        if "toe" not in self._made:
            self._made["toe"] = condyle.Model(knees.spring(law="toe-linear", stiffness=1000, slack_length=10))
        return self._made["toe"]


if __name__ == "__main__":
    unittest.main()
