#!/usr/bin/env python3
"""Leaf springs between a base and a rigid body, solved without elements: for LEAF-01 and 02.

Each leaf spring is an elastic line in space with axial, shear, bending and torsional stiffness
(Reissner; an axial force N adds N Ip/A to the torsional stiffness), integrated from the base by
Runge and Kutta; base forces and the place of the body come from Newton's method. It shares nothing
with spar. Prints the tables that tools/problems/flexures.py and the tests contain.
"""
import numpy as np


def skew(v):
    """The matrix of a cross product."""
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def turn(v):
    """The rotation by a vector."""
    a = np.linalg.norm(v)
    if a == 0:
        return np.eye(3)
    s = skew(v / a)
    return np.eye(3) + np.sin(a) * s + (1 - np.cos(a)) * s @ s


def vector(r):
    """The vector of a rotation below a half turn."""
    w = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / 2
    s = np.linalg.norm(w)
    return w if s == 0 else w / s * np.arctan2(s, (np.trace(r) - 1) / 2)


class Leaf:
    """A leaf spring of length l from a place, its axes the columns of `axes` (y across it)."""

    def __init__(self, l, h, b, e, nu, place, axes, steps=60):
        g = e / 2 / (1 + nu)
        self.ea, self.ga = e * h * b, g * h * b * 10 * (1 + nu) / (12 + 11 * nu)
        self.eiy, self.eiz = e * b * h**3 / 12, e * h * b**3 / 12
        odd = np.arange(1, 60, 2)
        self.git = g * h * b**3 / 3 * (1 - 192 / np.pi**5 * b / h * sum(
            np.tanh(odd * np.pi * h / 2 / b) / odd**5))
        self.polar = (h**2 + b**2) / 12
        self.l, self.place, self.axes, self.steps = l, np.array(place, float), axes, steps

    def rates(self, force, state):
        """Of place, axes and moment along the line; the force is constant."""
        r, moment = state[3:12].reshape(3, 3), state[12:]
        n, m = r.T @ force, r.T @ moment
        tangent = r @ np.array([1 + n[0] / self.ea, n[1] / self.ga, n[2] / self.ga])
        bend = np.array([m[0] / (self.git + n[0] * self.polar), m[1] / self.eiy, m[2] / self.eiz])
        return np.concatenate([tangent, (r @ skew(bend)).ravel(), np.cross(force, tangent)])

    def end(self, force, moment):
        """Place, axes and moment at the end, from force and moment at the base."""
        step = self.l / self.steps
        y = np.concatenate([self.place, self.axes.ravel(), moment])
        for _ in range(self.steps):
            a = self.rates(force, y)
            b = self.rates(force, y + step / 2 * a)
            c = self.rates(force, y + step / 2 * b)
            d = self.rates(force, y + step * c)
            y = y + step / 6 * (a + 2 * b + 2 * c + d)
        return y[:3], y[3:12].reshape(3, 3), y[12:]


class Flexure:
    """Leaf springs that end on a rigid body, whose place is that of its point `centre`."""

    def __init__(self, leaves, centre):
        self.leaves, self.centre = leaves, np.array(centre, float)
        ends = [leaf.place + leaf.l * leaf.axes[:, 0] for leaf in leaves]
        self.arms = [end - self.centre for end in ends]
        force = leaves[0].eiz / leaves[0].l**2
        self.units = np.array([force] * 3 + [force * leaves[0].l] * 3)
        self.unknowns = np.zeros(6 * len(leaves) + 6)
        self.scale = np.concatenate([np.tile(self.units, len(leaves)),
                                     [leaves[0].l] * 3 + [1.0] * 3])

    def residual(self, unknowns):
        """Gaps at the ends, then force and moment that the body needs, by their units."""
        u, body = unknowns * self.scale, unknowns[-6:] * self.scale[-6:]
        r = turn(body[3:])
        gaps, load = [], np.zeros(6)
        for k, (leaf, arm) in enumerate(zip(self.leaves, self.arms)):
            force, moment = u[6 * k:6 * k + 3], u[6 * k + 3:6 * k + 6]
            place, axes, end_moment = leaf.end(force, moment)
            arm = r @ arm
            gaps += [(place - self.centre - body[:3] - arm) / leaf.l,
                     vector(axes @ leaf.axes.T @ r.T)]
            load += np.concatenate([force, end_moment + np.cross(arm, force)])
        return np.concatenate([*gaps, load / self.units])

    def jacobian(self, unknowns):
        """By central differences."""
        columns = []
        for k in range(len(unknowns)):
            d = np.zeros(len(unknowns))
            d[k] = 1e-6
            columns.append((self.residual(unknowns + d) - self.residual(unknowns - d)) / 2e-6)
        return np.array(columns).T

    def move(self, component, value):
        """Give the body one coordinate; the load on that coordinate. The others are free."""
        row = len(self.unknowns) - 6 + component
        for _ in range(30):
            r = self.residual(self.unknowns)
            j = self.jacobian(self.unknowns)
            r[row] = self.unknowns[row] - value / self.scale[row]
            j[row] = 0
            j[row, row] = 1
            change = np.linalg.solve(j, -r)
            self.unknowns = self.unknowns + change
            if max(abs(change)) < 1e-9:
                break
        return self.residual(self.unknowns)[row] * self.units[component]

    def compliance(self, held):
        """Of the body, (6, 6), with one coordinate held."""
        j = self.jacobian(self.unknowns)
        row = len(self.unknowns) - 6 + held
        j[row] = 0
        j[row, row] = 1
        loads = np.vstack([np.zeros((len(j) - 6, 6)), np.diag(1 / self.units)])
        loads[row] = 0
        return self.scale[-6:, None] * np.linalg.solve(j, loads)[-6:]

    def place(self):
        """Displacement and rotation vector of the body."""
        return self.unknowns[-6:] * self.scale[-6:]


def guide(l=100.0, w=50.0, h=50.0, b=0.5, e=210000.0, nu=0.3):
    """Two parallel leaf springs along x, w from each other."""
    leaves = [Leaf(l, h, b, e, nu, [0, y, 0], np.eye(3)) for y in (0, w)]
    return Flexure(leaves, [l, w / 2, 0])


def cross(l=100.0, h=50.0, b=0.5, e=210000.0, nu=0.3):
    """Two leaf springs that cross at their middles at right angles."""
    a = l / np.sqrt(2)
    leaves = []
    for sign in (1, -1):
        x = np.array([sign, 1, 0]) / np.sqrt(2)
        y = np.array([-1, sign, 0]) / np.sqrt(2)
        leaves.append(Leaf(l, h, b, e, nu, [-sign * a / 2, 0, 0],
                           np.array([x, y, np.cross(x, y)]).T))
    return Flexure(leaves, [0, a / 2, 0])


def main():
    """Print the tables."""
    print("guide: y of the shuttle, force, x, compliances x, z, rx, ry with y held")
    flexure = guide()
    for stroke in np.linspace(2.5, 20, 8):
        force = flexure.move(1, stroke)
        c = flexure.compliance(1)
        print(f"{stroke:g}", *(f"{v:.9g}" for v in (force, flexure.place()[0], c[0, 0], c[2, 2],
                                                    c[3, 3], c[4, 4])))
    print("cross-hinge: angle in degrees, moment, x and y of the crossing,"
          " compliances x, y, z with the angle held")
    flexure = cross()
    for angle in np.linspace(2.5, 20, 8):
        moment = flexure.move(5, np.radians(angle))
        c = flexure.compliance(5)
        print(f"{angle:g}", *(f"{v:.9g}" for v in (moment, *flexure.place()[:2], c[0, 0], c[1, 1],
                                                   c[2, 2])))


if __name__ == "__main__":
    main()
