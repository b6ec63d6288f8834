"""STATIONARY, and EIGEN with complex frequencies: decks of tests/cases/rotating."""
import numpy as np

from .kit import Number, Problem

FLAP = {3: (4.7972785, 23.320264, 62.984967), 6: (7.3603730, 26.809082, 66.683914),
        12: (13.170150, 37.603112, 79.614478)}
WHIRL = {0: (-1181.9287, -138.43584, 138.43584, 1181.9287),
         100: (-1090.9326, -133.99864, 142.84466, 1282.0865),
         300: (-935.69486, -125.13441, 151.48916, 1509.3401)}


def solve(bench, deck, **settings):
    """The complex eigenvalues of a deck, as rows of real and imaginary part."""
    group = bench.run(f"tests/cases/rotating/{deck}.deck", **settings).analysis()
    return group["complex_eigenvalue"][()]


def rotating_channel(bench):
    """Theory 10, rotating."""
    problem = Problem("ROT-01", "Channel cantilever that turns about the vertical axis",
                      "independent implementation of the same element", "other program")
    problem.text("`tests/cases/rotating/channel.deck`: the channel of Fig. 11, Ω = 2 rad/s about"
                 " the axis through the clamp, lumped inertia, load at the upper web corner:"
                 " load (kN) at given deflections, 10 elements.")
    results = bench.run("tests/cases/rotating/channel.deck")
    factor = results.analysis()["load_factor"][()]
    problem.compare([(f"deflection {3 * (k + 1)} cm", Number(factor[k], wanted, 1e-5))
                     for k, wanted in ((9, 8.9698), (29, 10.7786), (69, 16.5885))], "load (kN)")
    return problem


def blade(bench):
    """EIG-09."""
    problem = Problem("EIG-09", "Rotating cantilever, flapping and lagging",
                      "Wright, Smith, Thresher, Wang, J. Appl. Mech. 49 (1982) 197; power series",
                      "published, exact solution")
    problem.text("`tests/cases/rotating/blade.deck`: EI = m = L = 1, hub radius 0, 40 elements,"
                 " STATIONARY at the rate η, then EIGEN; lagging is flapping with the square of"
                 " the rate taken from that of the frequency. Circular frequencies.")
    rows = []
    for eta, flap in FLAP.items():
        found = solve(bench, "blade", eta=eta, n=40)[:, 1]
        for k, ref in enumerate(flap):
            rows += [(f"η = {eta}, lag {k + 1}", Number(found[2 * k],
                                                        (ref**2 - eta**2)**0.5, 2e-3)),
                     (f"η = {eta}, flap {k + 1}", Number(found[2 * k + 1], ref, 2e-3))]
    problem.compare(rows, "ω")
    return problem


def disk(bench):
    """EIG-15."""
    problem = Problem("EIG-15", "Overhung disk on a massless shaft: whirl and critical speeds",
                      "Stodola and Green", "closed form")
    problem.text("`tests/cases/rotating/disk.deck`: EI = 8349.76, L = 0.5, m = 10, Jd = 0.05,"
                 " Jp = 0.1, one BEAM and XM. spar's frequencies are those in the frame that turns"
                 " with the shaft: ω of the table (inertial frame, forward positive) less Ω.")
    rows = []
    for rate, whirl in WHIRL.items():
        if rate == 0:
            results = bench.run("tests/cases/rotating/disk.deck", rate=0)
            found = 2 * np.pi * results.analysis()["frequency"][()]
            rows += [("Ω = 0, first", Number(found[0], whirl[2], 1e-3)),
                     ("Ω = 0, second", Number(found[2], whirl[3], 1e-3))]
            continue
        found = solve(bench, "disk", rate=rate)[:, 1]
        for wanted in whirl:
            nearest = found[abs(found - abs(wanted - rate)).argmin()]
            name = "forward" if wanted > 0 else "backward"
            rows.append((f"Ω = {rate}, {name} {abs(wanted):.0f}", Number(
                rate + np.sign(wanted - rate) * nearest, wanted, 1e-3)))
    for speed in (132.552059365, 712.676958208):
        found = solve(bench, "disk", rate=speed)[:, 1]
        rows.append((f"synchronous backward at Ω = {speed:.3f}, half the frequency", Number(
            found[abs(found - 2 * speed).argmin()] / 2, speed, 1e-3)))
    problem.compare(rows, "ω")
    return problem


def rotor(bench):
    """EIG-17."""
    problem = Problem("EIG-17", "Rigid gyroscopic rotor on two bearings", "rigid body",
                      "closed form")
    problem.text("`tests/cases/rotating/rotor.deck`: m = 10, Jd = 0.2, Jp = 0.3, bearings k = 1e6"
                 " in two directions at ±0.25, Ω = 500; two rigid beams, four TRUSSes. Inertial"
                 " frame, as above.")
    found = solve(bench, "rotor")[:, 1]
    rows = [(name, Number(500 + sign * found[k], wanted, 1e-4)) for name, k, sign, wanted in (
        ("translation, forward", 0, -1, 447.2135955),
        ("translation, backward", 2, -1, -447.2135955),
        ("conical, backward", 3, -1, -500), ("conical, forward", 1, 1, 1250))]
    problem.compare(rows, "ω")
    return problem


def beck(bench):
    """Beck's column."""
    problem = Problem("EIG-B", "Beck's column: flutter under a follower force", "Beck 1952",
                      "published")
    problem.text("`tests/cases/rotating/beck.deck`: EI = L = 1, 10 elements; the load from which on"
                 " a motion grows, between two loads 1e-4 apart.")
    low, high = 20.0, 20.1
    while high - low > 1e-4:
        middle = (low + high) / 2
        if solve(bench, "beck", p=middle)[:, 0].max() > 0:
            high = middle
        else:
            low = middle
    problem.compare([("critical load", Number(high, 20.0509, 1e-4))], "load")
    return problem


PROBLEMS = [rotating_channel, blade, disk, rotor, beck]
