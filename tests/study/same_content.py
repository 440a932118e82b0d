"""Whether HDF5 files hold the same: names, types, shapes, bytes and attributes, but for /provenance.

same_content.py FIRST OTHER...: ends with 0 where they do, 1 where not, 77 where h5py is missing.
"""
import sys

try:
    import h5py
except ImportError:
    sys.exit(77)


def bytes_of(values):
    if hasattr(values, "dtype") and values.dtype != object:
        return values.tobytes()
    return repr(values.tolist() if hasattr(values, "tolist") else values)


def content(name):
    found = {}
    with h5py.File(name, "r") as file:

        def look(path, item):
            if path == "provenance" or path.startswith("provenance/"):
                return
            what = [(key, bytes_of(item.attrs[key])) for key in sorted(item.attrs)]
            if isinstance(item, h5py.Dataset):
                what += [str(item.dtype), item.shape, bytes_of(item[()])]
            found[path] = what

        look("", file)
        file.visititems(look)
    return found


first = content(sys.argv[1])
if len(first) < 5:
    sys.exit(f"{sys.argv[1]} holds {len(first)} objects, expected a study")
for name in sys.argv[2:]:
    other = content(name)
    different = sorted(path for path in {*first, *other} if first.get(path) != other.get(path))
    if different:
        sys.exit(f"{name} differs from {sys.argv[1]} in /{', /'.join(different[:5])}")
