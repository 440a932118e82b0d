"""Results of Python beside those of the program's files: every dataset, to the last bit."""

import pathlib
import subprocess

import numpy as np

import condyle
import knees


def program(command, scene, output, *options, code=0):
    """Runs `condyle COMMAND SCENE -o OUTPUT`; returns what it wrote."""
    done = subprocess.run([knees.PROGRAM, command, scene, "-o", output, "--quiet", *options], capture_output=True, text=True)
    assert done.returncode == code, done.stderr
    return pathlib.Path(output)


def datasets(group, place=""):
    """Pairs of a place and what stands there, of a group and all that it holds."""
    for name, member in group.items():
        if isinstance(member, condyle.Group):
            yield from datasets(member, f"{place}{name}/")
        else:
            yield place + name, member


def expect_same(test, ours, theirs, but=()):
    """`but`: words in the places of datasets that differ from one computation to the next: times."""
    mine, other = dict(datasets(ours)), dict(datasets(theirs))
    test.assertEqual(sorted(mine), sorted(other))
    test.assertGreater(len(mine), 0)
    for place, values in mine.items():
        if any(word in place for word in but):
            continue
        if isinstance(values, tuple):
            test.assertEqual(values, other[place], place)
        else:
            np.testing.assert_array_equal(values, other[place], err_msg=place)
            test.assertEqual(np.asarray(values).dtype, np.asarray(other[place]).dtype, place)
