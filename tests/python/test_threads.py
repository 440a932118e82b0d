"""Several threads on one model, and what interrupts."""

import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np

import condyle
import knees


def in_threads(count, work):
    found, failed = [None] * count, []

    def run(i):
        try:
            found[i] = work(i)
        except BaseException as error:  # to be told by the test
            failed.append(error)

    threads = [threading.Thread(target=run, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if failed:
        raise failed[0]
    return found


class Threads(unittest.TestCase):
    def test_eight_threads_find_the_bits_of_one(self):
        model = knees.phantom()
        values = np.linspace(0, 90, 40)
        alone = condyle.sweep(model, values)
        for run in in_threads(8, lambda i: condyle.sweep(model, values)):
            np.testing.assert_array_equal(run.translation, alone.translation)
            np.testing.assert_array_equal(run.contacts["medial"].force, alone.contacts["medial"].force)
        one = [model.solve(flexion=v).translation for v in values[::4]]
        for many in in_threads(8, lambda i: [model.solve(flexion=v).translation for v in values[::4]]):
            np.testing.assert_array_equal(many, one)

    def test_the_interpreter_ends_while_daemon_threads_compute(self):
        for scene in ("knees.ball_on_ball()", "knees.spring(law=lambda L: (100 * L - 1000, 100, 50 * (L - 10) ** 2))"):
            script = f"""
import threading
import condyle, knees
model, begun = condyle.Model({scene}), threading.Event()
def work():
    solver = condyle.Solver(model)
    while True:
        condyle.sweep(model, [0, 1] * 20000, progress=lambda *_: begun.set())
        solver.solve()
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
begun.wait()
"""
            done = self.ended(script)
            self.assertEqual((done.returncode, done.stderr), (0, ""), scene)

    def ended(self, script):
        return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120,
                              cwd=pathlib.Path(knees.__file__).parent)

    def test_what_runs_at_exit_may_compute(self):
        done = self.ended("""
import atexit
def last():
    print(condyle.sweep(knees.ball_on_ball(), [0, 1]).converged.all())
atexit.register(last)
import condyle, knees
""")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "True\n", ""))

    def test_a_child_of_a_computation_counts_its_own_threads(self):
        done = self.ended("""
import os, threading
import condyle, knees
model, begun, children = condyle.Model(knees.ball_on_ball()), threading.Event(), []
def work():
    while True:
        condyle.sweep(model, [0, 1] * 20000, progress=lambda *_: begun.set())
def fork(*_):
    if not children:
        children.append(os.fork())
condyle.sweep(model, [0, 1], progress=fork)
if children[0] == 0:
    threading.Thread(target=work, daemon=True).start()
    begun.wait()
else:
    print(os.waitstatus_to_exitcode(os.waitpid(children[0], 0)[1]))
""")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "0\n", ""))

    def test_ctrl_c_ends_an_interpreter_that_waits_for_a_thread_that_waits(self):
        done = self.ended("""
import os, signal, threading
import condyle, knees
model, begun, never = condyle.Model(knees.ball_on_ball()), threading.Event(), threading.Event()
def wait(*_):
    begun.set()
    never.wait()
threading.Thread(target=lambda: condyle.sweep(model, [0, 1], progress=wait), daemon=True).start()
begun.wait()
print("waits", flush=True)
if os.fork() == 0:
    import time
    time.sleep(1)
    os.kill(os.getppid(), signal.SIGINT)
    os._exit(0)
""")
        self.assertEqual((done.returncode, done.stdout), (130, "waits\n"), done.stderr)

    def test_solvers_of_threads_do_not_see_each_others_numbers(self):
        model = knees.phantom()

        def work(i):
            solver = condyle.Solver(model)
            solver.set("aACL.slack_length", 20 + 0.2 * i)
            poses = [solver.solve(flexion=v) for v in (0, 10, 20)]
            return poses[-1].ligaments["aACL"].force

        together = in_threads(8, work)
        self.assertEqual(together, [work(i) for i in range(8)])
        self.assertEqual(len(set(together)), 8)

    def test_a_solver_of_two_threads_says_so(self):
        started, told = threading.Event(), []

        def slow(length):
            started.set()
            time.sleep(0.002)
            return 100 * (length - 10), 100, 50 * (length - 10) ** 2

        solver = condyle.Solver(condyle.Model(knees.spring(law=slow)))
        thread = threading.Thread(target=solver.solve)
        thread.start()
        started.wait()
        for call in (solver.solve, solver.reset, lambda: solver.set("pull.scale", 2), lambda: solver.get("pull.scale")):
            with self.assertRaisesRegex(RuntimeError, "another thread"):
                call()
        thread.join()
        self.assertTrue(solver.solve().converged)
        self.assertEqual(told, [])

    def test_other_threads_go_on_while_c_plus_plus_computes(self):
        counted = []
        done = threading.Event()

        def count():
            while not done.is_set():
                counted.append(1)
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = len(counted)
        condyle.sweep(knees.phantom(), np.linspace(0, 90, 1500))
        during = len(counted) - before
        done.set()
        thread.join()
        self.assertGreater(during, 3)


class Interrupts(unittest.TestCase):
    def interrupted(self, work):
        timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                work()
        finally:
            timer.join()

    def test_ctrl_c_ends_a_sweep(self):
        model = knees.phantom()
        self.interrupted(lambda: condyle.sweep(model, np.linspace(0, 90, 1000000)))
        self.assertTrue(model.solve(flexion=10).converged)

    def test_ctrl_c_ends_a_fit(self):
        scene = condyle.read_scene(knees.PHANTOM)

        def fits():
            while True:
                condyle.fit(scene)
        self.interrupted(fits)

    def test_a_progress_function_is_told_and_what_it_raises_comes_through(self):
        told = []
        run = condyle.sweep(knees.phantom(), [0, 10, 20], progress=lambda done, total: told.append((done, total)))
        self.assertEqual(told, [(1, 3), (2, 3), (3, 3)])
        self.assertEqual(len(run), 3)

        def stop(done, total):
            raise LookupError(f"{done} of {total}")
        with self.assertRaisesRegex(LookupError, "1 of 3"):
            condyle.sweep(knees.phantom(), [0, 10, 20], progress=stop)
        with self.assertRaisesRegex(LookupError, "^1 of 4"):
            condyle.fit(condyle.read_scene(knees.PHANTOM), progress=stop)
        with self.assertRaisesRegex(TypeError, "progress"):
            condyle.sweep(knees.phantom(), [0], progress=3)


if __name__ == "__main__":
    unittest.main()
