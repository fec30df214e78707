"""Reads the vtk folder of a results folder with VTK's own reader and compares it with results.json: vtk_reader_check.py DIR"""

import json
import math
import pathlib
import sys
import xml.etree.ElementTree as tree

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

LINE_ARRAYS = ["load_N_per_mm", "contact_stress_MPa", "gap_um", "error_um", "contact_deflection_um", "structural_deflection_um"]
ROUND_OFF = 1e-12  # relative; both are the same doubles


def read(path):
    complaints = []
    reader = vtkXMLPolyDataReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda _, what: complaints.append(what))
    assert reader.CanReadFile(str(path)), f"{path}: not a file that VTK can read"
    reader.SetFileName(str(path))
    reader.Update()
    assert not complaints, f"{path}: {complaints}"
    return reader.GetOutput()


def values(data, name):
    array = data.GetArray(name)
    assert array is not None, f"no array {name}"
    return [array.GetValue(i) for i in range(array.GetNumberOfTuples())]


def same(a, b):
    return (math.isnan(a) and b is None) or (b is not None and abs(a - b) <= ROUND_OFF * (1.0 + abs(b)))


def check_lines(data, position):
    points = [point for tooth in position["teeth"] for point in tooth["points"]]
    assert data.GetNumberOfPoints() == len(points)
    for name in LINE_ARRAYS:
        assert all(map(same, values(data.GetPointData(), name), (point[name] for point in points))), f"{name} differs"
    assert all(same(data.GetPoint(i)[2], point["z_mm"]) for i, point in enumerate(points)), "z differs"
    lengths = [data.GetCell(i).GetNumberOfPoints() for i in range(data.GetNumberOfCells())]
    assert lengths == [len(tooth["points"]) for tooth in position["teeth"] if len(tooth["points"]) > 1]


def check_flank(data, geometry, member):
    gear = geometry[member]
    centre = 0.0 if member == "pinion" else geometry["centre_distance_mm"]
    radii = values(data.GetPointData(), "radius_mm")
    for i, radius in enumerate(radii):
        x, y, _ = data.GetPoint(i)
        assert same(math.hypot(x - centre, y), radius), f"point {i} of the {member} is not at its radius"
    assert same(max(radii), 0.5 * gear["tip_form_diameter_mm"])
    assert all(data.GetCell(i).GetNumberOfPoints() == 4 for i in range(data.GetNumberOfCells()))
    assert data.GetNumberOfCells() == len(values(data.GetCellData(), "tooth")) > 0
    return max(map(abs, values(data.GetPointData(), "removal_um")))


def main():
    folder = pathlib.Path(sys.argv[1])
    results = json.loads((folder / "results.json").read_text())
    files, removed, peak = 0, 0.0, 0.0
    for index, loaded in enumerate(results["loaded"], start=1):
        sets = list(tree.parse(folder / "vtk" / f"contact-{index}.pvd").iter("DataSet"))
        assert len(sets) == 3 * len(loaded["cycle"]), f"case {index}: {len(sets)} files"
        for k, entry in enumerate(sets):
            position = loaded["cycle"][k // 3]
            assert abs(float(entry.get("timestep")) - position["phase"]) < 1e-8  # nine digits are written
            data = read(folder / "vtk" / entry.get("file"))
            if entry.get("part") == "0":
                check_lines(data, position)
                peak = max(peak, data.GetPointData().GetArray("contact_stress_MPa").GetRange()[1])
            else:
                removed = max(removed, check_flank(data, results["geometry"], ("pinion", "wheel")[int(entry.get("part")) - 1]))
            files += 1
    assert removed > 0.1, "no flank is modified after the optimisation"
    print(f"{files} files read by VTK: peak stress {peak:.2f} MPa, largest removal {removed:.2f} um")


main()
