"""Driven mechanisms: rigid ones by closed forms, a flexible one by two analyses."""
import numpy as np

from .kit import Number, Problem


def slider_crank(bench):
    """MBD-10."""
    problem = Problem("MBD-10", "Slider-crank at a steady speed", "x = r cos a + √(l² - r² sin² a)",
                      "closed form")
    deck = "tests/cases/kinematic/slider_crank.deck"
    problem.text(f"`{deck}`: r = 0.15, l = 0.3 m, 150 rad/s, KINEMATIC in steps of 30°.")
    results = bench.run(deck)
    group = results.analysis("kinematic")
    steps = len(group["time"])

    def of_slider(name):
        table = group[f"nodes/{name}"][()]
        return table.reshape(steps, -1, table.shape[-1])[:, results.node(3), 0]

    place, acceleration = 0.45 + of_slider("displacement"), of_slider("acceleration")
    degrees = (0, 30, 60, 90, 120, 180)
    angle = np.radians(degrees)
    exact = 0.15 * np.cos(angle) + np.sqrt(0.3**2 - (0.15 * np.sin(angle))**2)
    problem.compare([
        *((f"x at {d}° (m)", Number(place[d // 30], x, 1e-8)) for d, x in zip(degrees, exact)),
        ("acceleration at 0° (m/s²)", Number(acceleration[0], -5062.5, 1e-8)),
        ("acceleration at 180° (m/s²)", Number(acceleration[6], 1687.5, 1e-8))])
    return problem


class Linkage:
    """decks/misaligned_four_bar.deck: torque of the drive and what the rocker carries at its pivot,
    by step."""

    def __init__(self, bench, deck, **settings):
        results = bench.run(deck, **settings)
        group = results.analysis(next(iter(results.file["analysis"])))
        self.time = group["time"][()]
        element = results.file["model/elements/id"][()]
        last = np.flatnonzero(element == 3)[-1]
        self.rocker = group["elements/section_force_q"][()].reshape(len(self.time), len(element), -1)
        self.rocker = self.rocker[:, last]
        self.torque = -group["joints/stress"][()].reshape(len(self.time), -1, 6)[:, 0, 0]

    def at(self, time):
        """Torque of the drive, twist and bending out of the plane."""
        step = int(np.argmin(abs(self.time - time)))
        return [self.torque[step], self.rocker[step, 3], self.rocker[step, 5]]


def misaligned(bench):
    """FLX-08."""
    problem = Problem("FLX-08", "Four-bar linkage with a misaligned hinge",
                      "Bauchau et al., Multibody System Dynamics 37 (2016) 29: the linkage; INVERSE"
                      " on four times as many elements", "other analysis")
    deck = "decks/misaligned_four_bar.deck"
    problem.text(f"`{deck}`: a hinge 5° out of line makes a linkage of rigid bars lock; spar check"
                 " names the constraints. Of flexible bars it turns. Inertia forces are small at"
                 " 0.6 rad/s, so TRANSIENT (4 elements a bar, h = 0.02 s) has to find what INVERSE"
                 " finds from the driven motion without integration in time (16 elements a bar):"
                 " torque of the drive, twist and bending out of the plane of the rocker at its"
                 " pivot (Nm)."
                 " With all hinges in line nothing bends out of the plane.")
    motion = Linkage(bench, deck, end=4)
    driven = Linkage(bench, "tests/cases/kinematic/misaligned_four_bar.deck", end=4, parts=16)
    names = ("drive", "twist", "bending")
    rows = [(f"{name}, t = {t} s", Number(x, ref, 1e-3)) for t in (1, 2, 3, 4)
            for name, x, ref in zip(names, motion.at(t), driven.at(t))]
    plane = Linkage(bench, deck, end=4, angle=0)
    rows.append(("largest twist and bending, in line", Number(
        abs(plane.rocker[:, [3, 5]]).max(), 0, 1e-6, 2)))
    problem.compare(rows)
    return problem


PROBLEMS = [slider_crank, misaligned]
