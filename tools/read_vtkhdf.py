#!/usr/bin/env python3
"""Read /VTKHDF of result files with VTK's own reader and check it against the native datasets.

    python3 -m venv venv && venv/bin/pip install vtk h5py numpy
    venv/bin/python tools/read_vtkhdf.py OUT.h5...

Every step is read; the points at both ends of every element have to be where the node's
displacement and rotation put them. A section's warping may move them along its axis besides, by
no more than its largest omega times the warping coordinate.
"""
import sys

import h5py
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

TOLERANCE = 1e-9  # of the model's size; VTK and HDF5 keep double precision


def read_steps(path):
    """Yield value, points and displacement of every step, as VTK gives them."""
    reader = vtk.vtkHDFReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    for value in reader.GetOutputInformation(0).Get(key):
        reader.UpdateTimeStep(value)
        grid = reader.GetOutputDataObject(0)
        if grid.IsA("vtkPartitionedDataSet"):
            grid = grid.GetPartition(0)
        points = vtk_to_numpy(grid.GetPoints().GetData())
        yield value, points, vtk_to_numpy(grid.GetPointData().GetArray("displacement")), grid


def matrices(euler):
    """Rotation matrices of Euler parameters, scalar first."""
    e0, e1, e2, e3 = np.asarray(euler).T
    rows = [
        [1 - 2 * (e2**2 + e3**2), 2 * (e1 * e2 - e0 * e3), 2 * (e1 * e3 + e0 * e2)],
        [2 * (e1 * e2 + e0 * e3), 1 - 2 * (e1**2 + e3**2), 2 * (e2 * e3 - e0 * e1)],
        [2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), 1 - 2 * (e1**2 + e2**2)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


class Model:
    """What of /model the drawing depends on."""

    def __init__(self, file):
        self.position = file["model/nodes/position"][()]
        elements = file["model/elements"]
        self.node = elements["nodes"][()].reshape(-1, 2, 3)
        self.triad = elements["triad"][()].reshape(-1, 3, 3)  # rows eX, eY, eZ
        self.corners, self.omega = [], []
        for name in elements["section"].asstr()[()]:
            drawing = file.get("model/sections/drawings/" + name.strip("\0").replace("/", "_"))
            if drawing is None or "outline_principal" not in drawing:
                self.corners.append(np.zeros((1, 2)))
                self.omega.append(0.0)
            else:
                self.corners.append(drawing["outline_principal"][()])
                omega = drawing["omega"][()] if "omega" in drawing else [0.0]
                self.omega.append(np.abs(omega).max())

    def arms(self, e):
        """Corners of an element's section in global axes, undeformed."""
        return self.corners[e] @ self.triad[e, 1:]

    def end_points(self, stations):
        """Element, end and slice of points for each end of an element."""
        first = 0
        for e, corners in enumerate(self.corners):
            n = len(corners)
            yield e, 0, slice(first, first + n)
            yield e, 1, slice(first + (stations - 1) * n, first + stations * n)
            first += stations * n


def state(group, row, nodes):
    """Displacement, rotation matrices and warping of a recorded step."""
    rows = slice(row * nodes, (row + 1) * nodes)
    data = group["nodes"]
    return data["displacement"][rows], matrices(data["euler"][rows]), data["warping"][rows]


def rest(nodes):
    return np.zeros((nodes, 3)), np.tile(np.eye(3), (nodes, 1, 1)), np.zeros(nodes)


def check_file(path):
    with h5py.File(path) as file:
        model = Model(file)
        groups = [file["analysis"][name] for name in sorted(file["analysis"])]
        origin = file["VTKHDF/Steps/Origin"][()]
        nodes = len(model.position)
        size = np.ptp(model.position, axis=0).max()
        last, worst, steps, modes = rest(nodes), 0.0, 0, 0
        for value, points, motion, grid in read_steps(path):
            number, row = origin[steps]
            steps += 1
            stations = len(points) // sum(len(c) for c in model.corners)
            group = groups[number - 1]
            mode = "modes" in group
            if mode:
                modes += 1
                rows = slice(row * nodes, (row + 1) * nodes)
                data = group["modes/nodes"]
                u, spin, alpha = (data[k][rows] for k in ("displacement", "rotation", "warping"))
            else:
                last = state(group, row, nodes)
            for e, end, at in model.end_points(stations):
                p, r, w = model.node[e, end]
                turn = last[1][r]
                arms = model.arms(e)
                base = model.position[p] + arms
                if mode:
                    base = model.position[p] + last[0][p] + arms @ turn.T
                    wanted = u[p] + np.cross(spin[r], arms @ turn.T)
                    warping = model.omega[e] * abs(alpha[w])
                    free = model.omega[e] * abs(last[2][w])  # of the state itself
                else:
                    wanted = last[0][p] + arms @ turn.T - arms
                    warping, free = model.omega[e] * abs(last[2][w]), 0.0
                axis = turn @ model.triad[e, 0]
                off = motion[at] - wanted
                along = off @ axis
                off = off - np.outer(along, axis)
                start = np.abs(points[at] - base).max() - free
                bound = np.abs(along).max() - warping * (1 + 1e-6)
                if mode:  # the state's own warping turns with the mode
                    off = np.maximum(np.abs(off) - free * np.abs(spin[r]).max(), 0)
                worst = max(worst, np.abs(off).max(), start, bound)
        expected = sum(len(g["step"]) if "step" in g else len(g["multiplier" if "multiplier" in g
                       else "frequency"]) for g in groups)
    assert steps == expected == len(origin), f"{steps} steps read, {expected} in the file"
    assert worst <= TOLERANCE * size, f"points off by {worst:.3g}"
    print(f"{path}: VTK {vtk.vtkVersion.GetVTKVersion()} reads {steps} steps, {modes} of them modes; "
          f"{grid.GetNumberOfPoints()} points, {grid.GetNumberOfCells()} cells; "
          f"ends of beams within {worst / size:.1e} of the model's size")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for name in sys.argv[1:]:
        check_file(name)
