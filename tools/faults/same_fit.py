"""Whether two calibrations found the same: same_fit.py FIRST OTHER ends with 0 or says what differs.

A search that goes on from the best numbers of another one ends where its own tolerance says: the cost within 1e-6 of
itself, and numbers within 1 % of the sd that they are known to.
"""
import sys

import h5py
import numpy

COST, NUMBERS = 1e-6, 0.01


def found(name):
    with h5py.File(name, "r") as file:
        fit = file["calibrate"]
        parameters = fit["parameters"]
        return (fit["figures/cost"][0], parameters["mean"][()], parameters["sd"][()], fit["figures/stopped"][0])


(cost, values, sd, stopped), (other_cost, other_values, _, other_stopped) = found(sys.argv[1]), found(sys.argv[2])
if stopped or other_stopped:
    sys.exit("one of them was stopped")
if not abs(cost - other_cost) <= COST * abs(cost):
    sys.exit(f"cost {other_cost}, expected {cost}")
if (numpy.isnan(values) != numpy.isnan(other_values)).any():
    sys.exit("numbers that one of them has not")
far = numpy.nanmax(abs(values - other_values) / sd)
if not far <= NUMBERS:
    sys.exit(f"numbers that differ by {far:.2g} of their sd")
