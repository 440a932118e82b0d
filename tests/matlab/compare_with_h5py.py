"""compare_with_h5py.py FILE...: what Octave told of runs (check_runs.m) against what h5py reads, every dataset to the last bit."""

import sys

import h5py
import numpy as np


def datasets(group):
    """Absolute path and dataset, of all in a group."""
    for item in group.values():
        if isinstance(item, h5py.Dataset):
            yield item.name, item
        else:
            yield from datasets(item)


def check(dataset, units, shape, kind, values):
    expected = dataset.shape + (1,) * (2 - len(dataset.shape))
    assert shape == expected, (dataset.name, shape, expected)
    assert units == dataset.attrs.get("units", ""), (dataset.name, units)
    if kind == "texts":
        read = [text.encode() for text in np.atleast_1d(dataset.asstr()[()])]
        told = [bytes.fromhex(word.rstrip(".")) for word in values.split()]
        assert told == read, (dataset.name, told, read)
    else:
        told = np.array(values.split(), dtype=float)
        assert np.array_equal(told, dataset[()].astype(float).ravel(), equal_nan=True), dataset.name


for name in sys.argv[1:]:
    with open(name, encoding="ascii") as lines:
        file, group = next(lines).rstrip("\n").split("\t")
        with h5py.File(file) as run:
            left = dict(datasets(run[group]))
            count = len(left)
            for line in lines:
                path, units, shape, kind, values = line.rstrip("\n").split("\t")
                check(left.pop(path), units, tuple(map(int, shape.split())), kind, values)
            assert not left, (file, sorted(left))
    print(f"{file} {group}: {count} datasets, the same in Octave and h5py")
