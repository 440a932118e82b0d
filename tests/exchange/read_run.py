"""read_run.py RUN.h5 DOC: runs the Python lines of the docs on a run, and looks up what the MATLAB lines ask for.

Prints what the Python lines print. Exits with 77 where h5py is missing."""
import re
import sys

try:
    import h5py
except ImportError:
    sys.exit(77)

run, doc = sys.argv[1], open(sys.argv[2]).read()
python = doc.split("### Python", 1)[1].split("###", 1)[0]
matlab = doc.split("### MATLAB", 1)[1].split("\n## ", 1)[0]
lines = [line[4:] for line in python.splitlines() if line.startswith("    ")]
assert len(lines) <= 12, "the docs promise ten lines"
exec("\n".join(lines).replace("RUN.h5", run), {})

with h5py.File(run) as file:
    for name in re.findall(r"h5read\(run, '([^']+)'\)", matlab):
        assert name in file, f"{name} is not in the file"
        print("MATLAB", name, file[name].shape)
