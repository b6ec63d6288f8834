"""Where the elements are: their axes as cubic Hermite curves, their sections swept along them."""
import numpy as np

FIRST, LAST = (0, 1, 2), (3, 4, 5)  # columns of /model/elements/nodes: place, rotation, warping
CENTRE_Y, CENTRE_Z = 5, 6           # columns of /model/sections/constants: shear centre


class Shapes:
    """Curves (elements, points, 3) and swept sections of a model in any state of its nodes."""

    def __init__(self, results, points=9):
        elements = results.file["model/elements"]
        nodes = elements["nodes"][()]
        keep = (nodes[:, FIRST[0]] >= 0) & (nodes[:, LAST[0]] >= 0)
        self.nodes = nodes[keep]
        self.triad = elements["triad"][()].reshape(-1, 3, 3)[keep]
        self.length = np.linalg.norm(elements["chord"][()], axis=1)[keep]
        self.centre = shear_centres(results)[keep]
        self.position = results.position
        self.xi = np.linspace(0, 1, points)

    def end(self, state, columns):
        """Positions (elements, 3), axes (elements, axis, 3), warping (elements) of one end."""
        displacement, rotation, warping = state
        place, turn, warp = self.nodes[:, columns].T
        axes = np.einsum("eij,eaj->eai", rotation[turn], self.triad)
        return (self.position + displacement)[place], axes, np.where(warp < 0, 0, warping[warp])

    def slope(self, axes, warping):
        """Tangent of the line of centroids, which winds about the shear centre as a beam twists."""
        y, z = self.centre.T
        return (axes[:, 0] + (warping * z)[:, None] * axes[:, 1]
                - (warping * y)[:, None] * axes[:, 2])

    def curves(self, state):
        """Lines of centroids; straight where an end has no rotations."""
        p, axes_p, warping_p = self.end(state, FIRST)
        q, axes_q, warping_q = self.end(state, LAST)
        straight = (self.nodes[:, [FIRST[1], LAST[1]]] < 0).any(1)[:, None]
        length = self.length[:, None]
        start = np.where(straight, q - p, length * self.slope(axes_p, warping_p))
        end = np.where(straight, q - p, length * self.slope(axes_q, warping_q))
        h1, h2, h3, h4 = (h[:, None] for h in hermite(self.xi))
        return h1 * p[:, None] + h2 * start[:, None] + h3 * q[:, None] + h4 * end[:, None]

    def swept(self, state, outline):
        """Points (elements, points, outline, 3) of a section's (y, z) carried along the beams."""
        curves = self.curves(state)
        _, axes_p, warping_p = self.end(state, FIRST)
        _, axes_q, warping_q = self.end(state, LAST)
        x = self.xi[:, None]
        axis_y = (1 - x) * axes_p[:, None, 1] + x * axes_q[:, None, 1]
        tangent = unit((1 - x) * axes_p[:, None, 0] + x * axes_q[:, None, 0])
        axis_y = unit(axis_y - (axis_y * tangent).sum(-1, keepdims=True) * tangent)
        axis_z = np.cross(tangent, axis_y)
        more = self.more_twist(axes_p, axes_q, warping_p, warping_q)
        axis_y, axis_z = (np.cos(more) * axis_y + np.sin(more) * axis_z,
                          np.cos(more) * axis_z - np.sin(more) * axis_y)
        outline = np.asarray(outline, float)
        return (curves[:, :, None] + outline[:, 0, None] * axis_y[:, :, None]
                + outline[:, 1, None] * axis_z[:, :, None])

    def more_twist(self, axes_p, axes_q, warping_p, warping_q):
        """What cubic interpolation with the warping adds to a uniform twist."""
        sine = ((axes_q[:, 1] * axes_p[:, 2]) - (axes_q[:, 2] * axes_p[:, 1])).sum(-1)
        twist = np.arctan2(sine, (axes_p[:, 1:] * axes_q[:, 1:]).sum((1, 2)))
        _, h2, h3, h4 = hermite(self.xi)
        more = (np.outer(twist, h3 - self.xi) + np.outer(self.length * warping_p, h2)
                + np.outer(self.length * warping_q, h4))
        uniform = (self.nodes[:, [FIRST[2], LAST[2]]] < 0).any(1)[:, None]
        return np.where(uniform, 0, more)[:, :, None]


def hermite(x):
    """Cubic polynomials of place, slope, place, slope on 0 to 1."""
    return 1 - 3 * x**2 + 2 * x**3, x * (1 - x)**2, 3 * x**2 - 2 * x**3, x**3 - x**2


def shear_centres(results):
    """Shear centre (y, z) of each element's section from its centroid; 0 without a section."""
    names = list(results.file["model/sections/name"][()])
    constants = results.file["model/sections/constants"][()].reshape(len(names), -1)
    table = np.vstack([constants[:, [CENTRE_Y, CENTRE_Z]].reshape(-1, 2), [0, 0]])
    return table[[names.index(name) if name in names else len(names)
                  for name in results.file["model/elements/section"][()]]]


def unit(vectors):
    """Vectors of length one."""
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
