#!/usr/bin/env python3
"""Read /VTKHDF of result files with VTK's own reader and check it against the rest of the file.

    tools/check_vtk.py              run the decks of CASES and check their files
    tools/check_vtk.py OUT.h5...    check these files

Where a point has to be is worked out anew from /model and /analysis: at both ends of every beam
the node's displacement and rotation carry the section's corners, and its warping moves them by
-omega alpha along the beam; trusses are straight between their nodes, the nodes of other joints are
dots. Of motions in time some states are drawn only: which is worked out from their times. The program is $SPAR_PROGRAM or build/spar. Called by `make check-vtk`,
which installs vtk, h5py and numpy.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

from drawn_model import MODE, Mode, Model, State, expected_steps, from_vectors

ROOT = Path(__file__).resolve().parents[1]
TOLERANCE = 1e-9         # of the model's size: points are kept in double precision
ROUNDED = 2.0**-24       # of the largest value: displacements are rounded to single precision
SINGLE = 5e-7            # of the largest value: the same, of what single precision is computed with
VERTEX, LINE, POLYGON, QUAD = 1, 3, 7, 9

# What it is, deck, settings, drawn states, modes.
CASES = [
    ("post-buckling path of a channel, modes at its end", "drawing/channel.deck", {}, 30, 3),
    ("post-buckling path by arc length, lines", "path/channel_arc.deck", {}, None, 0),
    ("flexural-torsional buckling modes", "drawing/column.deck", {}, 0, 3),
    ("buckling about loaded states", "buckling/preloaded.deck", {}, 1, 4),
    ("critical point of a path", "path/bracket.deck", {}, 8, 1),
    ("roll-up to a full circle", "static/rollup.deck", {"angle": 0.7}, 10, 0),
    ("spatial bend", "static/bend45.deck", {}, 6, 0),
    ("nine kinds of sections", "../../decks/sections.deck", {}, 2, 0),
    ("five more kinds", "drawing/shapes.deck", {}, 2, 0),
    ("frame, two patterns", "../../decks/frame.deck", {}, 13, 0),
    ("rigid links", "../../decks/chain.deck", {}, 4, 0),
    ("trusses, with and without section", "drawing/braced.deck", {}, 3, 9),
    ("joints, at rest, in modes and in motion", "drawing/joints.deck", {}, 23, 4),
    ("motion in time, every third step drawn", "drawing/swing.deck", {}, 137, 0),
    ("the same with steps by their error", "drawing/swing.deck", {"rule": "TOL", "value": 1e-5}, None, 0),
    ("many lines, one piece each", "../bench/cantilever.deck", {"n": 600, "steps": 2}, 2, 0),
]


# --- what VTK says --------------------------------------------------------------------------------

def read_steps(path):
    """Yield time value and grid of every step, as VTK's reader gives them."""
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    for value in information.Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()) or []:
        reader.UpdateTimeStep(value)
        grid = reader.GetOutputDataObject(0)
        if grid.IsA("vtkPartitionedDataSet"):
            grid = grid.GetPartition(0)
        yield value, grid


def fields_of(grid):
    """Arrays by name."""
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
            for data in (grid.GetPointData(), grid.GetCellData())
            for i in range(data.GetNumberOfArrays())}


def cells_of(grid):
    """Points of each cell, and types."""
    array = grid.GetCells()
    ids, at = vtk_to_numpy(array.GetConnectivityArray()), vtk_to_numpy(array.GetOffsetsArray())
    types = [grid.GetCellType(i) for i in range(grid.GetNumberOfCells())]
    return [ids[a:b] for a, b in zip(at[:-1], at[1:])], types


# --- the checks -----------------------------------------------------------------------------------

class Checks:
    """The largest deviation of each check over the steps of a file, and what it may be."""

    def __init__(self):
        self.worst = {}

    def below(self, name, deviation, allowed):
        """A deviation; NaN is beyond everything."""
        ratio = np.max(np.abs(deviation), initial=0.0) / allowed
        ratio = np.inf if np.isnan(ratio) else ratio
        self.worst[name] = max(self.worst.get(name, 0.0), ratio)

    def true(self, name, fact):
        """A fact."""
        self.worst[name] = max(self.worst.get(name, 0.0), 0.0 if fact else np.inf)


def check_cells(checks, grid, points):
    """Cells are of known types, have size, use all points, and no point twice."""
    cells, types = cells_of(grid)
    checks.true("cells: types", set(types) <= {VERTEX, LINE, POLYGON, QUAD})
    used = np.unique(np.concatenate(cells))
    checks.true("cells: all points are used", np.array_equal(used, np.arange(len(points))))
    for ids, kind in zip(cells, types):
        place = points[ids] - points[ids[0]]
        if kind == VERTEX:
            measure, count = 1, len(ids) == 1
        elif kind == LINE:
            measure, count = np.linalg.norm(place[1]), len(ids) == 2
        else:  # twice the area
            measure = np.linalg.norm(np.cross(place[1:-1], place[2:]).sum(axis=0))
            count = len(ids) == 4 or kind == POLYGON
        checks.true("cells: have size", measure > 0 and count and len(set(ids)) == len(ids))


def check_initial(checks, model, points):
    """Sections stand evenly along the straight beams, trusses reach from node to node, dots are nodes."""
    dots = len(points) - len(model.dot)
    checks.below("initial dots", points[dots:] - model.position[model.dot], TOLERANCE * model.size)
    for b, ids in model.bars(len(points)):
        checks.below("initial points of trusses", points[ids] - model.position[model.bar_node[b]],
                     TOLERANCE * model.size)
    for e, at in model.beams(len(points)):
        arms = model.corners[e] @ model.triad[e, 1:]
        p, q = model.position[model.node[e, :, 0]]
        for xi, ids in zip(np.linspace(0, 1, len(at)), at):
            checks.below("initial points", points[ids] - (p + xi * (q - p) + arms),
                         TOLERANCE * model.size)


def check_motion(checks, model, motion, fields, points, initial):
    """Points and displacements at both ends of all beams and trusses."""
    places = points + fields["displacement"]
    rounded = TOLERANCE * model.size + ROUNDED * np.abs(fields["displacement"]).max()
    check_dots(checks, model, motion, fields, rounded)
    for b, ids in model.bars(len(points)):
        nodes = model.bar_node[b]
        base = model.position[nodes]
        if isinstance(motion, Mode):
            base = base + motion.about.motion[nodes]
        checks.below("points of trusses", points[ids] - base, TOLERANCE * model.size)
        checks.below("displacement of trusses", fields["displacement"][ids] - motion.motion[nodes],
                     rounded)
        checks.true("rotation of trusses", not fields["rotation"][ids].any())
    for e, at in model.beams(len(points)):
        for end in (0, 1):
            wanted = motion.moved(model, e, end)
            base = initial[at[-end]]
            if isinstance(motion, Mode):
                base = base + motion.about.moved(model, e, end)[0]
                turned = None
            else:
                wanted, turned = wanted[0], motion.turn[model.node[e, end, 1]]
            ids = at[-end]
            checks.below("points", points[ids] - (base if turned is None else initial[ids]),
                         TOLERANCE * model.size)
            checks.below("displacement", fields["displacement"][ids] - wanted, rounded)
            checks.below("deformed points", places[ids] - base - wanted, rounded)
            rotation = fields["rotation"][ids].astype(float)
            if turned is None:
                spin = motion.spin[model.node[e, end, 1]]
                checks.below("spin of modes", rotation - spin, SINGLE * np.abs(motion.spin).max())
            else:
                checks.below("rotation", from_vectors(rotation) - turned, 4 * SINGLE)


def check_dots(checks, model, motion, fields, rounded):
    """Displacement and rotation of the dots are those of the joints' nodes."""
    if not model.dot:
        return
    ids = slice(len(fields["displacement"]) - len(model.dot), None)
    checks.below("displacement of dots", fields["displacement"][ids] - motion.motion[model.dot], rounded)
    rotation = fields["rotation"][ids].astype(float)
    turns = np.array(model.dot_turn) >= 0
    nodes = np.array(model.dot_turn)[turns]
    checks.true("dots without rotation", not rotation[~turns].any())
    if isinstance(motion, Mode):
        checks.below("spin of dots", rotation[turns] - motion.spin[nodes],
                     SINGLE * max(np.abs(motion.spin).max(), 1e-30))
    else:
        checks.below("rotation of dots", from_vectors(rotation[turns]) - motion.turn[nodes], 4 * SINGLE)


def end_forces(model, data, row, mode):
    """Section forces at both ends of all beams, those of modes to first order (docs/theory.md)."""
    n = len(model.node)
    rows = slice(row * n, (row + 1) * n)
    if not mode:
        return data["elements/section_force_p"][rows], data["elements/section_force_q"][rows]
    s = data["modes/elements/stress"][rows].T
    p, q = model.position[model.node[:, :, 0]].transpose(1, 0, 2)
    length = np.linalg.norm(q - p, axis=1)
    shared = [s[0], s[4] - s[5], s[3] - s[2], length * s[1]]
    return (np.array([*shared, length * s[2], length * s[4], -length**2 * s[6]]).T,
            np.array([*shared, length * s[3], length * s[5], length**2 * s[7]]).T)


def check_forces(checks, model, ends, grid, fields):
    """Section forces in the middle of the cells, stresses at the ends of the beams."""
    at_p, at_q = ends
    largest = np.maximum(np.abs(ends).max(axis=(0, 1)), 1e-30)
    owner, middle = np.empty(grid.GetNumberOfPoints(), int), np.empty(grid.GetNumberOfPoints())
    stress = fields.get("axial_stress")
    scale = max(float(np.abs(stress).max()), 1e-30) if stress is not None else 1.0
    for e, at in model.beams(grid.GetNumberOfPoints()):
        owner[at], middle[at] = e, np.linspace(0, 1, len(at))[:, None]
        c = model.constants[e]
        if stress is None or c is None:
            continue
        for ids, (force_n, _, _, _, m_y, m_z, b) in zip(at[[0, -1]], (at_p[e], at_q[e])):
            y, z = model.corners[e].T
            wanted = force_n / c[0] + m_y * z / c[1] - m_z * y / c[2]
            if c[4] > 0:
                wanted = wanted - b * model.omega[e] / c[4]
            checks.below("axial stress", stress[ids] - wanted, SINGLE * scale)
    beams = grid.GetNumberOfCells() - len(model.bar) - len(model.dot)
    checks.true("dots have no forces", not fields["section_force"][beams + len(model.bar):].any())
    for ids, force in zip(cells_of(grid)[0][:beams], fields["section_force"]):
        e, xi = owner[ids[0]], middle[ids].mean()
        checks.true("cells: of one beam", (owner[ids] == e).all())
        checks.below("section forces", (force - (1 - xi) * at_p[e] - xi * at_q[e]) / largest, SINGLE)


def check_bars(checks, model, normal, grid, fields):
    """Forces and stresses of trusses from the normal forces of all joints."""
    cells, forces = cells_of(grid)[0], fields["section_force"]
    largest = max(np.abs(normal).max(initial=0.0), 1e-30)
    for b, ids in model.bars(grid.GetNumberOfPoints()):
        at = b - len(model.bar) - len(model.dot)
        checks.true("cells of trusses", list(cells[at]) == list(ids))
        wanted = np.append(normal[model.bar[b]], np.zeros(6))
        checks.below("forces of trusses", forces[at] - wanted, SINGLE * largest)
        if "axial_stress" in fields:
            area = model.bar_area[b]
            stress = normal[model.bar[b]] / area if area > 0 else 0.0
            checks.below("stresses of trusses", fields["axial_stress"][ids] - stress,
                         SINGLE * max(abs(stress), 1e-30))


def check_file(path):
    """Checks of a file, and how many states and modes it holds."""
    checks = Checks()
    with h5py.File(path) as file:
        model = Model(file)
        groups = [file["analysis"][name] for name in sorted(file["analysis"])]
        origin = [tuple(row) for row in file["VTKHDF/Steps/Origin"][()]]
        wanted = expected_steps(groups)
        state, initial, values = State(model), None, []
        for k, (value, grid) in enumerate(read_steps(path)):
            values.append(value)
            number, row = origin[k][:2]
            group = groups[number - 1]
            points = vtk_to_numpy(grid.GetPoints().GetData())
            fields = fields_of(grid)
            if initial is None:
                initial = file["VTKHDF/Points"][:len(points)]
                check_initial(checks, model, initial)
                check_cells(checks, grid, initial)
            checks.true("number of points and cells", len(points) == len(initial)
                        and grid.GetNumberOfCells() == file["VTKHDF/NumberOfCells"][0])
            for name, field in fields.items():
                checks.true(f"{name} is finite", np.isfinite(field).all())
            if row < 0:
                point = group[f"critical/{-row:04}"]
                last = point.attrs["step"] - 2
                about = State(model, group["nodes"], last) if last >= 0 else State(model)
                motion = Mode(model, point, 0, about)
            elif "modes" in group:
                motion = Mode(model, group["modes/nodes"], row, state)
            else:
                state = motion = State(model, group["nodes"], row)
            if row >= 0:
                ends = end_forces(model, group, row, motion is not state)
                check_forces(checks, model, ends, grid, fields)
                normal = np.zeros(0)
                if model.joints:
                    stress = "joints/stress" if motion is state else "modes/joints/stress"
                    normal = group[stress][row * model.joints:][:model.joints, 0]
                check_bars(checks, model, normal, grid, fields)
            check_motion(checks, model, motion, fields, points, initial)
        checks.true("all states and modes are there, once",
                    sorted(origin) == sorted(w[:2] for w in wanted))
        checks.true("steps counted from 1", values == list(range(1, len(wanted) + 1))
                    and file["VTKHDF/Steps"].attrs["NSteps"] == len(wanted))
    modes = sum(kind == MODE for _, _, kind in wanted)
    return checks, len(wanted) - modes, modes


# --- running --------------------------------------------------------------------------------------

class Count:
    """Passed and failed checks, with a line for each failure."""

    def __init__(self):
        self.passed = self.failed = 0

    def add(self, what, name, ratio):
        """A check passes if its deviation is at most what is allowed."""
        if ratio <= 1:
            self.passed += 1
        else:
            self.failed += 1
            print(f"FAILED {what}: {name}, {ratio:.3g} times what is allowed")


def check(path, what, count):
    """Check a file and print a line of it."""
    checks, states, modes = check_file(path)
    for name, ratio in checks.worst.items():
        count.add(what, name, ratio)
    print(f"{what}: {states} states, {modes} modes, {len(checks.worst)} checks, deformed points within"
          f" {checks.worst.get('deformed points', np.inf):.2g} of what is allowed")
    return states, modes


def run_cases(count):
    """Run the decks and check their files."""
    program = os.environ.get("SPAR_PROGRAM", str(ROOT / "build/spar"))
    with tempfile.TemporaryDirectory() as folder:
        for what, deck, settings, states, modes in CASES:
            out = Path(folder) / "out.h5"
            words = [word for name, value in settings.items() for word in ("-D", f"{name}={value}")]
            subprocess.run([program, "run", str(ROOT / "tests/cases" / deck), "--quiet", "-o",
                            str(out), *words], check=True)
            found = check(out, what, count)
            count.add(what, f"{states} states and {modes} modes",
                      0 if found[0] == states or states is None and found[0] > 10 else np.inf)
            count.add(what, f"{modes} modes", 0 if found[1] == modes else np.inf)


def main():
    """Check files or cases."""
    count = Count()
    if len(sys.argv) > 1:
        for name in sys.argv[1:]:
            check(name, name, count)
    else:
        run_cases(count)
    print(f"VTK {vtkVersion.GetVTKVersion()}")
    print(f"{count.passed} passed, {count.failed} failed")
    sys.exit(count.failed > 0)


if __name__ == "__main__":
    main()
