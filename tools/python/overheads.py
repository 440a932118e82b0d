"""What Python adds to C++: the same poses of the phantom, solved in C++ alone and from Python, in turns in one process.

Times are those of the processor for this thread, least of the turns: other programs on the machine do not count."""

import time

import numpy as np

import condyle
from condyle import _condyle

TURNS, SOLVES, POSES = 7, 1000, 10000


def least(measured):
    return 1e6 * min(measured)


def seconds(work):
    begin = time.thread_time()
    work()
    return time.thread_time() - begin


def warm_solves(model):
    """Per pose: a warm solve in C++, from Python, and with numbers looked at by either way."""
    solver = condyle.Solver(model)
    values = np.linspace(10, 20, SOLVES)
    as_floats = [float(value) for value in values]
    times = {"C++": [], "Python": [], "looked": [], "asked": []}

    def solve():
        for value in as_floats:
            solver.solve(flexion=value)

    def solve_and_look():
        for value in as_floats:
            pose = solver.solve(flexion=value)
            pose.translation, pose.ligament_forces

    def solve_and_ask():
        for value in as_floats:
            solver.solve(flexion=value).ligaments["aACL"].force

    for _ in range(TURNS):
        times["C++"].append(_condyle._seconds_of_solves(solver, "flexion", values) / SOLVES)
        times["Python"].append(seconds(solve) / SOLVES)
        times["looked"].append(seconds(solve_and_look) / SOLVES)
        times["asked"].append(seconds(solve_and_ask) / SOLVES)
    return [least(times[way]) for way in times]


def sweeps(model):
    """Per pose: a sweep in C++, from Python, and the columns that a plot needs on top of it."""
    values = np.linspace(0, 90, POSES)
    alone, whole, columns = [], [], []
    for turn in range(10):
        runs = []

        def in_cpp():
            alone.append(_condyle._seconds_of_sweep(model, "flexion", values) / POSES)

        def from_python(runs=runs):
            whole.append(seconds(lambda: runs.append(condyle.sweep(model, values))) / POSES)

        for way in (in_cpp, from_python) if turn % 2 else (from_python, in_cpp):
            way()
        run = runs.pop()

        def look(run=run):
            return run.values, run.status, run.translation, run.joint.flexion, [run.ligaments[n].force for n in run.ligaments]
        columns.append(seconds(look) / POSES)
    return least(alone), least(whole), least(columns)


def main():
    model = condyle.Model(condyle.read_scene("data/phantom/knee.toml"))
    alone, python, looked, asked = warm_solves(model)
    print("| a pose of the phantom | C++ | from Python | Python's share |")
    print("|---|---|---|---|")
    print(f"| warm `solve(flexion=...)` | {alone:.1f} µs | {python:.1f} µs | {python - alone:.1f} µs |")
    print(f"| the same, and `.translation`, `.ligament_forces` | {alone:.1f} µs | {looked:.1f} µs | {looked - alone:.1f} µs |")
    print(f"| the same, and `.ligaments[\"aACL\"].force` | {alone:.1f} µs | {asked:.1f} µs | {asked - alone:.1f} µs |")
    alone, whole, columns = sweeps(model)
    print(f"| of a sweep of 10,000 | {alone:.1f} µs | {whole:.1f} µs | {whole - alone:.1f} µs |")
    print(f"| its columns: status, pose, joint, all ligaments | | {columns:.1f} µs | {columns:.1f} µs |")


main()
