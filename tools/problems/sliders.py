"""Loads and masses that move along beams: decks of tests/cases/slider."""
import numpy as np

from .kit import Number, Problem
from .motions import Motion

DECKS = "tests/cases/slider"
FORCE = 1e-3


def moving_force(time, speed, place=0.5, modes=200):
    """Deflection of a beam of unit length, rigidity and mass by a unit force that enters at 0."""
    n = np.arange(1, modes + 1)
    own, drive = (n * np.pi)**2, n * np.pi * speed
    return np.sum(2 * np.sin(n * np.pi * place) * (np.sin(drive * time) - drive / own
                  * np.sin(own * time)) / (own**2 - drive**2))


def moving_mass(time, speed, mass, modes=30, h=1e-4):
    """Deflection under a mass with a unit force, from the equations of sine modes (implicit)."""
    n = np.arange(1, modes + 1)
    own = (n * np.pi)**2
    q, v = np.zeros(modes), np.zeros(modes)
    found, steps = [], np.rint(np.asarray(time) / h).astype(int)

    def shapes(t):
        x = n * np.pi * speed * t
        return np.sin(x), np.cos(x) * n * np.pi, -np.sin(x) * own

    def rest(t, q, v):
        s, slope, bend = shapes(t)
        pull = 1 - mass * (2 * speed * slope @ v + speed**2 * bend @ q)
        right = 2 * (s * pull) - own**2 * q
        # (1 + 2 m s s') a = right, by the formula of Sherman and Morrison
        return right - 2 * mass * s * (s @ right) / (1 + 2 * mass * s @ s)

    for i in range(steps.max() + 1):
        if i in steps:
            found.append(shapes(i * h)[0] @ q)
        t = i * h
        k1 = rest(t, q, v)
        k2 = rest(t + h / 2, q + h / 2 * v, v + h / 2 * k1)
        k3 = rest(t + h / 2, q + h / 2 * v + h**2 / 4 * k1, v + h / 2 * k2)
        k4 = rest(t + h, q + h * v + h**2 / 2 * k2, v + h * k3)
        q = q + h * v + h**2 / 6 * (k1 + k2 + k3)
        v = v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return np.array(found)


def crossing(bench):
    """SLD-01."""
    problem = Problem("SLD-01", "A force that crosses a beam",
                      "L. Fryba, Vibration of solids and structures under moving loads: series",
                      "closed form")
    problem.text(f"`{DECKS}/moving_load.deck`: simply supported beam, the slider is driven from end"
                 " to end at the constant speed v, α = v L √(μ/EI)/π of the critical one; h ="
                 " L/1000 v. Deflection of the middle over F L³/48 EI; between nodes the force bends"
                 " a part less than it should, by a share that falls with the fourth power of the"
                 " parts' number.")
    rows = []
    for speed, parts in ((1, 8), (1, 16), (2, 8), (2, 16)):
        motion = Motion(bench, "moving_load", folder=DECKS, v=speed, parts=parts, h=0.001 / speed)
        for share in (0.3, 0.5, 0.8):
            time = share / speed
            found = motion.of_node("displacement", f"1.{parts // 2}")[motion.at(time), 2]
            rows.append((f"α = {speed / np.pi:.3f}, {parts} parts, v t = {share} L",
                         Number(-48 * found / FORCE, 48 * moving_force(time, speed),
                                1e-3 if parts == 8 else 2e-4)))
    problem.compare(rows, "middle")
    return problem


def with_mass(bench):
    """SLD-02."""
    problem = Problem("SLD-02", "A mass that crosses a beam",
                      "equations of 30 sine modes with w,tt + 2 v w,xt + v² w,xx under the mass",
                      "exact solution")
    problem.text(f"`{DECKS}/moving_load.deck` with a mass of half the beam's on the slider, α ="
                 " 0.318, 16 parts; deflection under the mass over F L³/48 EI.")
    motion = Motion(bench, "moving_load", folder=DECKS, parts=16, h=0.0005, m=0.5, r=0.5)
    shares = (0.25, 0.4, 0.5, 0.6, 0.75)
    wanted = moving_mass(shares, 1, 0.5)
    problem.compare([(f"under the mass, v t = {share} L",
                      Number(-48 * motion.of_node("displacement", 9)[motion.at(share), 2] / FORCE,
                             48 * ref, 2e-4)) for share, ref in zip(shares, wanted)])
    return problem


PROBLEMS = [crossing, with_mass]
