"""Whether HDF5 files hold the same: names, types, shapes, bytes and attributes, but for /provenance and times.

same_content.py [--within R] FIRST OTHER...: ends with 0 where they do, 1 where not, 77 where h5py is missing. With R
numbers may differ by R of the largest of their dataset, or of 1.
"""
import sys

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

within = 0.0
if sys.argv[1] == "--within":
    within = float(sys.argv[2])
    del sys.argv[1:3]


def plain(values):
    return repr(values.tolist() if hasattr(values, "tolist") else values)


def content(name):
    found = {}
    with h5py.File(name, "r") as file:

        def look(path, item):
            if path == "provenance" or path.startswith("provenance/") or path.endswith("seconds"):
                return
            what = [(key, plain(item.attrs[key])) for key in sorted(item.attrs) if key != "created"]
            found[path] = (what, item[()] if isinstance(item, h5py.Dataset) else None)

        look("", file)
        file.visititems(look)
    return found


def same(a, b):
    if a is None or b is None:
        return False
    (words, x), (other_words, y) = a, b
    if words != other_words or type(x) is not type(y):
        return False
    if not hasattr(x, "dtype") or x.dtype == object:
        return plain(x) == plain(y)
    if x.dtype != y.dtype or x.shape != y.shape:
        return False
    if x.tobytes() == y.tobytes():
        return True
    if within == 0 or x.dtype.kind != "f" or (numpy.isnan(x) != numpy.isnan(y)).any():
        return False
    x, y = numpy.nan_to_num(x), numpy.nan_to_num(y)
    return bool((abs(x - y) <= within * max(1, abs(x).max())).all())


first = content(sys.argv[1])
if len(first) < 5:
    sys.exit(f"{sys.argv[1]} holds {len(first)} objects, expected a result")
for name in sys.argv[2:]:
    other = content(name)
    different = sorted(path for path in {*first, *other} if not same(first.get(path), other.get(path)))
    if different:
        sys.exit(f"{name} differs from {sys.argv[1]} in /{', /'.join(different[:5])}")
