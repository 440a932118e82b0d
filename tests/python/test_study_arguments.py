"""Whatever a study is asked for, the interpreter lives and an exception names what is wrong. The same arguments each time."""

import unittest

import condyle
from test_studies import drawer, two_balls
from test_study import text

try:
    from hypothesis import HealthCheck, given, settings
    from hypothesis import strategies as st
except ImportError:
    st = None

EXPECTED = (condyle.InputError, TypeError, KeyError, OverflowError)


@unittest.skipIf(st is None, "hypothesis is not installed")
class Anything(unittest.TestCase):
    if st is not None:
        numbers = st.one_of(st.floats(), st.integers(-10, 10), st.integers(max_value=0), st.integers(min_value=2**60))
        leaves = st.one_of(numbers, st.none(), st.booleans(), st.text(max_size=8), st.binary(max_size=4))
        things = st.recursive(leaves, lambda inner: st.lists(inner, max_size=3), max_leaves=5)
        modest = settings(max_examples=40, derandomize=True, deadline=None, database=None,
                          suppress_health_check=list(HealthCheck))

        @given(st.sampled_from(["laxity", "compare", "simulate", "calibrate"]),
               st.dictionaries(st.sampled_from(["degree", "strain", "progress", "starts", "samples", "seed", "threads", "resume"]),
                               things, max_size=2), st.one_of(things, st.just(None)))
        @modest
        def test_options(self, command, options, scene):
            given_scene = {"laxity": drawer([0], [0, 1]), "simulate": two_balls(time=0.002)}.get(command, scene)
            try:
                getattr(condyle, command)(given_scene, **options)
            except EXPECTED:
                pass

        @given(st.dictionaries(st.sampled_from(["folder", "samples", "seed", "threads", "resume", "progress"]), things,
                               min_size=1, max_size=2))
        @modest
        def test_options_of_studies(self, options):
            try:
                condyle.study(text(samples=3), **options)
            except EXPECTED:
                pass

        @given(st.one_of(things, st.text(max_size=30).map(lambda line: line + "\n"),
                         st.tuples(st.sampled_from(["samples", "design", "outputs", "specimens", "seed", "precision", "of", "sd", "what"]),
                                   st.one_of(st.text(max_size=6).map(repr), numbers.map(repr)))))
        @modest
        def test_texts_of_studies(self, change):
            study = change
            if isinstance(change, tuple):
                lines = [line for line in text(samples=3).splitlines() if not line.startswith(change[0] + " ")]
                lines.insert(-1 if change[0] in ("of", "sd", "what") else 1, f"{change[0]} = {change[1]}")
                study = "\n".join(lines) + "\n"
            try:
                condyle.study(study)
            except EXPECTED:
                pass

        @given(st.text(max_size=20), st.sampled_from(["", "outputs/", "bands/", "bands/aACL.force/"]))
        @modest
        def test_places_of_studies(self, place, group):
            try:
                self.study()[group + place]
            except EXPECTED:
                pass

    made = []

    def study(self):
        if not self.made:
            self.made.append(condyle.study(text(samples=3)))
        return self.made[0]


if __name__ == "__main__":
    unittest.main()
