"""How far results of one configuration are from those of another: compare.py NAME REFERENCE FOLDER.

One line for each file: how many of its datasets have the same bits, and the largest difference in mm, deg and N. Ends with 1
where one is more than what rounding makes of a well-posed pose.
"""
import pathlib
import sys

import h5py
import numpy

# What differs by design or tells how it was computed, not what was found.
PASSED_OVER = ("seconds", "newton/", "provenance", "event_seconds", "route", "fit/")
# Of a well-posed pose: rounding errors times the condition of Newton's matrix (docs/equilibrium.md).
TOLERANCE = {"mm": 1e-6, "deg": 1e-6, "N": 1e-4}
# A motion is integrated to 1e-9 a step (network/integrate_options.h), in steps of another length where a bit differs.
OF_MOTIONS = 100


def numbers(file):
    found = {}

    def look(path, item):
        if not isinstance(item, h5py.Dataset) or item.dtype.kind not in "fiu":
            return
        if not any(word in path for word in PASSED_OVER):
            found[path] = (item[()], item.attrs.get("units", ""))

    file.visititems(look)
    return found


def difference(a, b):
    """Where both are numbers; one that is a number alone counts as infinite."""
    a, b = numpy.asarray(a, float), numpy.asarray(b, float)
    if a.shape != b.shape:
        return numpy.inf
    with numpy.errstate(invalid="ignore"):
        gap = numpy.where((a == b) | (numpy.isnan(a) & numpy.isnan(b)), 0, numpy.abs(a - b))
    gap[numpy.isnan(gap)] = numpy.inf
    return float(gap.max()) if gap.size else 0.0


def main():
    name, reference, folder = sys.argv[1:]
    away = 0
    for path in sorted(pathlib.Path(reference).glob("*.h5")):
        other = pathlib.Path(folder) / path.name
        if not other.exists():
            continue
        with h5py.File(path) as a, h5py.File(other) as b:
            ours, theirs = numbers(a), numbers(b)
        same = sum(numpy.array_equal(v, theirs[k][0], equal_nan=v.dtype.kind == "f") for k, (v, _) in ours.items()
                   if k in theirs)
        worst = {unit: 0.0 for unit in TOLERANCE}
        for key, (values, unit) in ours.items():
            if unit in TOLERANCE:
                worst[unit] = max(worst[unit], difference(values, theirs[key][0]) if key in theirs else numpy.inf)
        factor = OF_MOTIONS if any(key.startswith("simulate/") for key in ours) else 1
        beyond = any(worst[unit] > factor * most for unit, most in TOLERANCE.items())
        away |= beyond
        told = "the same bits" if same == len(ours) == len(theirs) else \
            f"{same} of {len(ours)} datasets; " + ", ".join(f"{worst[u]:.0e} {u}" for u in TOLERANCE)
        print(f"{name:10} {path.stem:18} {told}{': further than rounding' if beyond else ''}")
    return away


sys.exit(main())
