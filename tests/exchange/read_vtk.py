"""read_vtk.py FOLDER STEM: reads the .pvd series and their .vtp files with VTK, and holds them to the CSV beside them.

Exits with 77 where VTK is missing."""
import csv
import os
import sys
import xml.etree.ElementTree as xml

try:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    sys.exit(77)

folder, stem = sys.argv[1:3]
numbers = {}
with open(f"{folder}/{stem}.csv") as file:
    for row in csv.DictReader(file):
        key = (float(row["swept"]), row["quantity"], row["name"], row["component"])
        numbers[key] = float(row["value"])


def steps(kind):
    for entry in xml.parse(f"{folder}/{stem}_{kind}.pvd").getroot().iter("DataSet"):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(os.path.join(folder, entry.get("file")))
        reader.Update()
        yield float(entry.get("timestep")), int(entry.get("part")), reader.GetOutput()


def names(data):
    array = data.GetCellData().GetAbstractArray("name")
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


count = 0
for swept, _, data in steps("ligaments"):
    for i, name in enumerate(names(data)):
        a, b = (data.GetCell(i).GetPoints().GetPoint(k) for k in (0, 1))
        length = sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5
        force = data.GetCellData().GetArray("force_N").GetValue(i)
        assert abs(length - numbers[swept, "ligament", name, "length"]) < 1e-9, name
        assert force == numbers[swept, "ligament", name, "force"], name
        count += 1
assert count == 13 * 3, count

for swept, _, data in steps("contacts"):
    for i, name in enumerate(names(data)):
        force = data.GetPointData().GetArray("force_N").GetTuple3(i)
        if numbers[swept, "contact", name, "points"] == 1:
            for axis, value in zip("xyz", force):
                assert abs(value - numbers[swept, "contact", name, "force_" + axis]) < 1e-9, name

parts = {}
for swept, part, data in steps("bones"):
    assert data.GetNumberOfPolys() > 20000
    parts.setdefault(part, []).append(data.GetBounds())
assert sorted(len(bounds) for bounds in parts.values()) == [3, 3]
femur, tibia = parts[0], parts[1]
assert femur[0] == femur[2], "the femur stands still"
assert tibia[2][2] > tibia[0][2] + 20, "the flexed tibia no longer reaches as far down"
