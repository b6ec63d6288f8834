"""What a result file of spar says about its drawing: where points have to be, which steps there are.

For check_vtk.py; worked out from /model and /analysis, not from /VTKHDF.
"""
import numpy as np

STATE, MODE = 0, 1       # kinds of steps; modes of critical points are modes
INTERVALS = 200          # of a motion in time at most, a state each is drawn


def rotations(euler):
    """Rotation matrices of Euler parameters, scalar first."""
    e0, e1, e2, e3 = np.asarray(euler).T
    rows = [
        [1 - 2 * (e2**2 + e3**2), 2 * (e1 * e2 - e0 * e3), 2 * (e1 * e3 + e0 * e2)],
        [2 * (e1 * e2 + e0 * e3), 1 - 2 * (e1**2 + e3**2), 2 * (e2 * e3 - e0 * e1)],
        [2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), 1 - 2 * (e1**2 + e2**2)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def from_vectors(theta):
    """Rotation matrices of rotation vectors (n, 3)."""
    angle = np.linalg.norm(theta, axis=1)
    half = 0.5 * np.sinc(angle / (2 * np.pi))  # sin(angle/2)/angle
    return rotations(np.column_stack([np.cos(angle / 2), half[:, None] * theta]))


class Model:
    """What of /model the drawing depends on."""

    def __init__(self, file):
        self.position = file["model/nodes/position"][()]
        self.placed = file["model/nodes/kind"][:, 0] == 1
        elements = file["model/elements"]
        self.node = elements["nodes"][()].reshape(-1, 2, 3)
        self.triad = elements["triad"][()].reshape(-1, 3, 3)  # rows eX, eY, eZ
        self.size = np.ptp(self.position, axis=0).max()
        names = [name.strip("\0") for name in file["model/sections/name"].asstr()[()]] \
            if "model/sections/name" in file else []
        self.corners, self.omega, self.constants = [], [], []
        for name, status in zip(elements["section"].asstr()[()], elements["mode_status"][()]):
            name = name.strip("\0")
            drawing = file.get(f"model/sections/drawings/{name.replace('/', '_')}") if name else None
            constants = file["model/sections/constants"][names.index(name)] if name else None
            self.constants.append(constants)
            if drawing is None:
                self.corners.append(np.zeros((1, 2)))
                self.omega.append(np.zeros(1))
            else:
                self.corners.append(drawing["outline_principal"][()])
                self.omega.append(corner_omega(drawing))
            if constants is None or constants[4] == 0 or not (status == 1).any():
                self.omega[-1] = np.zeros(len(self.corners[-1]))
        self.read_bars(file.get("model/joints"), dict(zip(names, file["model/sections/constants"][()]))
                       if names else {})

    def read_bars(self, joints, constants):
        """Trusses: row of /model/joints, nodes, area (0: unknown)."""
        self.joints = 0 if joints is None else len(joints["id"])
        kinds = [] if joints is None else [kind.strip("\0 ") for kind in joints["type"].asstr()[()]]
        self.bar = [j for j, kind in enumerate(kinds) if kind == "TRUSS"]
        self.bar_node = [joints["nodes"][j, [0, 2]] for j in self.bar]
        names = [joints["section"].asstr()[j].strip("\0") for j in self.bar]
        self.dot, self.dot_turn = [], []
        if joints is not None:
            self.read_dots(joints["nodes"][()].reshape(-1, 2, 2), kinds)
        self.bar_area = [constants[name][0] if name else 0.0 for name in names]

    def read_dots(self, nodes, kinds):
        """Nodes of joints that have a place, in their order, and those by which they turn (-1: not)."""
        found = {}
        for ends, kind in zip(nodes, kinds):
            for place, turn in () if kind in ("TRUSS", "GEAR") else ends:
                at = place if place >= 0 else turn
                if self.placed[at]:
                    found[at] = turn
        self.dot = sorted(found)
        self.dot_turn = [found[at] for at in self.dot]

    def beams(self, points):
        """Element, and the points of each of its stations, (stations, corners)."""
        first = 0
        stations = (points - 2 * len(self.bar) - len(self.dot)) // max(1, sum(len(c) for c in self.corners))
        for e, corners in enumerate(self.corners):
            n = len(corners)
            yield e, first + np.arange(stations * n).reshape(stations, n)
            first += stations * n

    def bars(self, points):
        """Truss, and its two points: they are behind those of the beams."""
        first = points - 2 * len(self.bar) - len(self.dot)
        for b in range(len(self.bar)):
            yield b, first + 2 * b + np.arange(2)


def corner_omega(drawing):
    """Warping coordinates of the corners of an outline."""
    corners = len(drawing["outline_principal"])
    if "omega" not in drawing or "plates" not in drawing:
        return np.zeros(corners)
    omega, plates = drawing["omega"][()], drawing["plates"][()]
    if corners == 4 * len(plates) and (drawing["polygon"][()] > 0).sum() == corners - 4:
        return omega[plates[:, [0, 1, 1, 0]]].ravel()  # an open section: a rectangle each wall
    return np.resize(omega, corners)                   # a closed one: outside and inside


class State:
    """Where the nodes are."""

    def __init__(self, model, data=None, row=0):
        n = len(model.position)
        if data is None:
            self.motion, self.turn, self.warping = np.zeros((n, 3)), np.tile(np.eye(3), (n, 1, 1)), \
                np.zeros(n)
        else:
            rows = slice(row * n, (row + 1) * n)
            self.motion = data["displacement"][rows]
            self.turn = rotations(data["euler"][rows])
            self.warping = data["warping"][rows]

    def moved(self, model, e, end):
        """Displacement of the corners of a beam's end, and its section's axis and arms now."""
        p, r, w = model.node[e, end]
        arms = model.corners[e] @ model.triad[e, 1:]
        axis, now = self.turn[r] @ model.triad[e, 0], arms @ self.turn[r].T
        alpha = self.warping[w] if w >= 0 else 0.0
        return self.motion[p] + now - arms - alpha * np.outer(model.omega[e], axis), axis, now


class Mode:
    """How the nodes move about a state."""

    def __init__(self, model, data, row, about):
        n = len(model.position)
        rows = slice(row * n, (row + 1) * n)
        self.motion, self.spin, self.warping = (
            data[name][rows] for name in ("displacement", "rotation", "warping"))
        self.about = about

    def moved(self, model, e, end):
        """Displacement of the corners of a beam's end: the differential of State.moved."""
        p, r, w = model.node[e, end]
        _, axis, now = self.about.moved(model, e, end)
        alpha = self.about.warping[w] if w >= 0 else 0.0
        rate = self.warping[w] if w >= 0 else 0.0
        return self.motion[p] + np.cross(self.spin[r], now) - np.outer(
            model.omega[e], rate * axis + alpha * np.cross(self.spin[r], axis))


def expected_steps(groups):
    """(analysis, row, kind) of every state and mode that is to be drawn."""
    wanted, start = [], 0.0
    for number, group in enumerate(groups, 1):
        rows = np.arange(len(group.get("step", ())))
        if bytes(group.attrs["kind"]).strip(b"\0") in (b"transient", b"kinematic", b"inverse"):
            rows = drawn_rows(group["time"][()], start)
            start = group["time"][-1]
        wanted += [(number, row, STATE) for row in rows]
        modes = group.get("multiplier", group.get("frequency", ()))
        wanted += [(number, row, MODE) for row in range(len(modes))]
        wanted += [(number, -int(name), MODE) for name in group.get("critical", ())]
    return wanted


def drawn_rows(time, start):
    """Rows of a motion in time that are drawn: the first of each interval, and the last."""
    whole, steps = (time[-1] - start) / INTERVALS, np.diff(time)
    if np.ptp(steps[:-1]) < 1e-6 * steps[0]:  # equal, but perhaps the last
        count = np.ceil((time[-1] - start) / steps[0] - 1e-6)
        whole = np.ceil(count / INTERVALS) * steps[0]
    interval = np.floor((time - start) / whole + 1e-5)
    return np.union1d(np.unique(interval, return_index=True)[1], len(time) - 1)
