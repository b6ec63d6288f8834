"""A result file of spar: analyses, steps, modes, and series along a path (docs/results.md)."""
import h5py
import numpy as np

COMPONENTS = {"X": 0, "Y": 1, "Z": 2}
IN_TIME = ("transient", "kinematic", "inverse")


class ResultError(Exception):
    """What a user asked for is not in the file."""


def rotation_matrices(euler):
    """Rotation matrices (..., 3, 3) of Euler parameters (..., 4), scalar first."""
    e0, vector = euler[..., 0, None, None], euler[..., 1:]
    outer = vector[..., :, None] * vector[..., None, :]
    square = (vector**2).sum(-1)[..., None, None]
    return (e0**2 - square) * np.eye(3) + 2 * outer + 2 * e0 * skew(vector)


def skew(vector):
    """Matrices (..., 3, 3) whose product with x is vector × x."""
    x, y, z = np.moveaxis(vector, -1, 0)
    zero = np.zeros_like(x)
    return np.stack([np.stack([zero, -z, y], -1), np.stack([z, zero, -x], -1),
                     np.stack([-y, x, zero], -1)], -2)


class Results:
    """One file, open for reading until it is closed or its `with` block ends."""

    def __init__(self, path):
        self.file = h5py.File(path, "r")
        self.path = str(path)
        model = self.file["model"]
        self.position = model["nodes/position"][()]
        self.node_id = model["nodes/id"][()]
        self.node_part = model["nodes/part"][()]
        self.title = self._text(self.file.attrs.get("title", b""))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()

    @staticmethod
    def _text(value):
        return value.decode() if isinstance(value, bytes) else str(value)

    def analysis(self, name=None, kinds=("static", "stationary", "buckling", "eigen")):
        """Group of an analysis by its number or name; without one, the last of the kinds."""
        groups = self.file["analysis"]
        if name is None:
            found = [g for g in groups.values() if self.kind(g) in kinds]
        else:
            found = [g for key, g in groups.items()
                     if name in (key, key.partition("_")[2], key.partition("_")[0].lstrip("0"))]
        if not found:
            raise ResultError(f"{self.path} has no analysis {name or ' or '.join(kinds)};"
                              f" it has {', '.join(groups) or 'none'}")
        return found[-1]

    def kind(self, group):
        """static, transient, buckling, ..."""
        return self._text(group.attrs["kind"])

    def node(self, word):
        """Row of the node called `7`, or `7.2` for an inner node of the divided element 7."""
        number, _, part = str(word).partition(".")
        try:
            rows = np.flatnonzero((self.node_id == int(number))
                                  & (self.node_part == int(part or 0)))
        except ValueError:
            raise ResultError(f"'{word}' is not a node: write 7, or 7.2") from None
        if not rows.size:
            raise ResultError(f"{self.path} has no node {word}")
        return rows[0]

    def stacked(self, group, path):
        """A stacked table of nodes by step or mode: (steps, nodes, columns)."""
        table = group[path][()]
        nodes = len(group["nodes/index"] if "nodes/index" in group else self.position)
        return table.reshape(-1, nodes, *table.shape[1:])

    def kept_row(self, group, word):
        """Row of a node among those that the analysis keeps."""
        row = self.node(word)
        if "nodes/index" not in group:
            return row
        found = np.flatnonzero(group["nodes/index"][:, 0] == row)
        if not found.size:
            raise ResultError(f"{group.name} has not kept node {word}: see OUTPUT NODES")
        return found[0]

    def series(self, group, path):
        """One number for each step; a sign in front reverses it.

        load_factor, time, nodes/ID/X, nodes/ID/velocity/X, nodes/ID/angle (of rotation, in
        radians), markers/NAME/Z, joints/ID/strain/1, or any other dataset of the analysis with one
        number a step, as energy/kinetic.
        """
        if path.startswith("-"):
            return -self.series(group, path[1:])
        kind, _, rest = path.partition("/")
        name, _, component = rest.rpartition("/")
        if kind == "nodes" and component:
            return self._of_node(group, name, component)
        if kind == "joints" and component:
            return self._of_joint(group, name, component)
        if kind == "markers" and component and f"markers/{name}" in group:
            return group[f"markers/{name}"][:, self._column(component)]
        data = group.get(path)
        if data is None or not hasattr(data, "shape") or data.ndim != 1:
            raise ResultError(f"{group.name} has no series '{path}'")
        return data[()]

    def _of_joint(self, group, name, mode):
        name, _, quantity = name.partition("/")
        ids = self.file.get("model/joints/id")
        rows = np.flatnonzero(ids[()] == int(name)) if ids is not None and name.isdigit() else []
        table = group.get(f"joints/{quantity}") if quantity else None
        if not len(rows) or table is None or not mode.isdigit() or not 1 <= int(mode) <= 6:
            raise ResultError(f"{group.name} has no series 'joints/{name}/{quantity}/{mode}':"
                              " write joints/ID/strain/1")
        return table[()].reshape(-1, len(ids), 6)[:, rows[0], int(mode) - 1]

    def _of_node(self, group, name, component):
        name, _, quantity = name.partition("/")
        row = self.kept_row(group, name)
        if quantity:
            if f"nodes/{quantity}" not in group:
                raise ResultError(f"{group.name} has no nodes/{quantity}")
            return self.stacked(group, f"nodes/{quantity}")[:, row, self._column(component)]
        if component == "angle":
            euler = self.stacked(group, "nodes/euler")[:, row]
            return 2 * np.arctan2(np.linalg.norm(euler[:, 1:], axis=1), abs(euler[:, 0]))
        if component == "warping":
            return self.stacked(group, "nodes/warping")[:, row]
        return self.stacked(group, "nodes/displacement")[:, row, self._column(component)]

    @staticmethod
    def _column(component):
        try:
            return COMPONENTS[component.upper()]
        except KeyError:
            raise ResultError(f"'{component}' is not a component: X, Y or Z") from None

    def in_time(self, group):
        """Whether an analysis is a motion in time."""
        return self.kind(group) in IN_TIME

    @staticmethod
    def rows(group, steps):
        """Rows from 0 of recorded steps."""
        recorded = group["step"][()]
        for step in steps:
            if not recorded[0] <= step <= recorded[-1]:
                raise ResultError(f"{group.name} has steps {recorded[0]} to {recorded[-1]},"
                                  f" not {step}")
        return [int(np.flatnonzero(recorded == step)[0]) for step in steps]

    def levels(self, group, steps):
        """Time or load factor of recorded steps; of the initial state 0."""
        series = group["time" if self.in_time(group) else "load_factor"]
        known = [step for step in steps if step > 0 or self.in_time(group)]
        value = dict(zip(known, (series[row] for row in self.rows(group, known))))
        return [value.get(step, 0.0) for step in steps]

    def step_state(self, group, step):
        """Displacements, rotation matrices, warping of a recorded step; 0: the initial state, of a
        motion in time the one it starts from."""
        nodes = len(self.position)
        if step == 0 and not self.in_time(group):
            return np.zeros((nodes, 3)), np.tile(np.eye(3), (nodes, 1, 1)), np.zeros(nodes)
        if "nodes/index" in group:
            raise ResultError(f"{group.name} has not kept all nodes: see OUTPUT NODES")
        row = self.rows(group, [step])[0]
        displacement, euler, warping = (self.stacked(group, f"nodes/{name}")[row]
                                        for name in ("displacement", "euler", "warping"))
        return displacement, rotation_matrices(euler), warping

    def mode_state(self, group, mode, scale):
        """The same of a mode from 1, its largest displacement made `scale`; linear in it."""
        displacement = self.stacked(group, "modes/nodes/displacement")
        if not 1 <= mode <= len(displacement):
            raise ResultError(f"{group.name} has modes 1 to {len(displacement)}, not {mode}")
        displacement = displacement[mode - 1]
        rotation = self.stacked(group, "modes/nodes/rotation")[mode - 1]
        warping = self.stacked(group, "modes/nodes/warping")[mode - 1]
        size = np.ptp(self.position, 0).max()
        angle = np.linalg.norm(rotation, axis=1).max()
        largest = max(np.linalg.norm(displacement, axis=1).max(), size * angle / 10)
        factor = scale / largest
        return factor * displacement, np.eye(3) + skew(factor * rotation), factor * warping
