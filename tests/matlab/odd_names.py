"""odd_names.py FILE: an HDF5 file with names, texts and shapes that a run may have and seldom has."""

import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1], "w") as file:
    file["a b"] = np.arange(24.0).reshape(2, 3, 4)
    file["a-b"] = np.array([[1.5, np.nan, np.inf], [-np.inf, 5e-324, 0.1]])
    file["1st"] = np.zeros((0, 3))
    file["numbers"] = np.array([-1, 0, 200], dtype="i4")
    texts = ['a "b" \\n c', "two\nlines\tand\\", "", "Übung 12°"]
    file.create_dataset("texts", data=texts, dtype=h5py.string_dtype())
    file["texts"].attrs["meaning"] = ["point", "line"]
    file["long"] = "line of a scene\n" * 9000
    file["quoted \"name\""] = 2.5
    for name in ("a b", "numbers"):
        file[name].attrs["units"] = "N/mm^2"
