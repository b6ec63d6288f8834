"""Paths through limit points and bifurcations: decks of tests/cases/path."""
import numpy as np

from .exact import elliptic
from .kit import Number, Problem


def lee(bench):
    """STA-11."""
    problem = Problem("STA-11", "Lee's frame: limit points and snap-back",
                      "Lee, Manuel and Rossow 1968 (published limits 1.8532 to 1.8558); own exact"
                      " boundary-value problem, rigid in shear", "exact solution")
    deck = "tests/cases/path/lee.deck"
    results = bench.run(deck)
    group = results.analysis()
    p, v, u = (np.concatenate([[0], results.series(group, path)])
               for path in ("load_factor", "-nodes/3/Z", "nodes/3/X"))
    limits = [factor for kind, factor, *_ in results.critical if kind == "limit point"]
    back, forth = extrema(v)
    problem.text(f"`{deck}`: two members of 120 cm, hinged ends, 20 elements, arc length with"
                 f" default settings: {len(p) - 1} steps. v is the deflection under the load, u its"
                 " way to the side. The first limit is exact; the other references come from a"
                 " spline through a coarse exact path and are good to 0.5 %. The turning points of"
                 " v are those of a parabola through three steps.")
    problem.compare([("first limit load (kN)", Number(limits[0], 1.8556728, 1e-3)),
                     ("second limit load (kN)", Number(limits[1], -0.9414452, 5e-3)),
                     ("v where it turns back (cm)", Number(back, 61.002975, 5e-3)),
                     ("v where it turns forth (cm)", Number(forth, 50.748555, 5e-3))])
    problem.picture("lee.png", "Lee's frame: path with its limit points, and shapes",
                    "lee", results, group, p, v, u, limits)
    return problem


def extrema(v):
    """First maximum and following minimum, by parabolas through three points."""
    inner = range(1, len(v) - 1)
    top = next(i for i in inner if v[i] > v[i - 1] and v[i] >= v[i + 1])
    low = next(i for i in inner if i > top and v[i] < v[i - 1] and v[i] <= v[i + 1])
    return [v[i] - (v[i + 1] - v[i - 1])**2 / (8 * (v[i + 1] - 2 * v[i] + v[i - 1]))
            for i in (top, low)]


def williams(bench):
    """STA-09."""
    problem = Problem("STA-09", "Williams' toggle: snap-through",
                      "Williams, QJMAM 17 (1964) 451; own exact boundary-value problem",
                      "exact solution")
    deck = "tests/cases/path/williams.deck"
    results = bench.run(deck)
    factor = results.series(results.analysis(), "load_factor")
    exact = [25.201325, 33.491862, 32.833646, 31.283552, 36.072556, 53.285291, 88.164286]
    limits = [x for kind, x, *_ in results.critical if kind == "limit point"]
    problem.text(f"`{deck}`: half span 12.943 in, rise 0.386 in, 16 elements, displacement control"
                 " of the apex. Between the limit points the path is unstable: one mode, as found.")
    rows = [(f"P at w = 0.{k} in (lb)", Number(x, ref, 1e-3))
            for k, (x, ref) in enumerate(zip(factor, exact), 1)]
    rows += [(f"{name} limit load (lb)", Number(x, ref, 1e-3))
             for name, x, ref in zip(("first", "second"), limits, (33.861233, 31.262583))]
    problem.compare(rows)
    return problem


def column(bench):
    """PATH-01."""
    problem = Problem("PATH-01", "Column that buckles and is followed",
                      "Euler's elastica: P/P1 = (2K/π)², tip by 2k/K and 2E/K - 1, k = sin(θ/2)",
                      "closed form")
    deck = "tests/cases/path/column.deck"
    results = bench.run(deck)
    group = results.analysis()
    p, x, z, angle = (results.series(group, path) for path in (
        "load_factor", "nodes/2/X", "nodes/2/Z", "nodes/2/angle"))
    problem.text(f"`{deck}`: a perfect cantilever of ten elements. The bifurcation is found, its"
                 " branch taken along the critical mode (BRANCH ON), and followed by arc length to"
                 " a tip rotation of 120°. Load over Euler's P1 at steps of the path, against the"
                 " closed form at the same rotation of the tip.")
    rows = [("bifurcation P/P1", Number(results.critical[0][1], 1.0, 1e-4))]
    steps = [k for k in range(len(p)) if angle[k] > 0.3][::4] + [len(p) - 1]
    for k in dict.fromkeys(steps):
        modulus = np.sin(angle[k] / 2)
        whole, second = elliptic(modulus)
        theta = f"θ = {np.degrees(angle[k]):.4g}°"
        rows += [(f"P/P1 at {theta}", Number(p[k], (2 * whole / np.pi)**2, 1e-3))]
        if k == len(p) - 1:
            rows += [(f"deflection/L at {theta}", Number(abs(x[k]), 2 * modulus / whole, 1e-3)),
                     (f"height/L at {theta}", Number(1 + z[k], 2 * second / whole - 1, 1e-3))]
    problem.compare(rows)
    problem.picture("column.png", "Column: secondary branch and shapes",
                    "column", results, group, p, angle)
    return problem


def critical_states(bench):
    """STB-07 STB-11 STB-15."""
    problem = Problem("STB-07 STB-11 STB-15", "Bifurcations of loaded states",
                      "Timoshenko and Gere; Prandtl, Michell; Argyris 1979, code_aster SSLL105;"
                      " own exact determinants", "closed form")
    problem.text("Decks of `tests/cases/path` with STABILITY ON: the first bifurcation of the"
                 " loaded, deflected beam, by the inertia of the tangent and bisection. I beam on"
                 " forks under uniform moment (8 elements): the pre-buckling deflection raises the"
                 " moment by 1/sqrt((1 - Iz/Iy)(1 - GIt/EIy ...)), 3.9 %. Narrow strips without"
                 " warping stiffness (32 elements), which twist uniformly within an element: an"
                 " error of order (1/n)². L bracket (20 elements), loads outward and inward.")
    cases = [("I beam, moment (kN m)", "lateral", {}, 78.364563, 1e-3),
             ("strip, cantilever, tip load, PL²/√(EIz GIt)", "strip_cantilever", {}, 4.0125993,
              1e-3),
             ("strip on forks, load in the middle", "strip_middle", {}, 16.936, 1e-3),
             ("strip on forks, weight qL", "strip_weight", {}, 28.315, 1e-3),
             ("L bracket, load outward (N)", "bracket", {}, 1.0875182, 5e-3),
             ("L bracket, load inward (N)", "bracket", {"f": -1}, 0.68042757, 5e-3)]
    rows = []
    for name, deck, settings, wanted, allowed in cases:
        results = bench.run(f"tests/cases/path/{deck}.deck", **settings)
        kind, factor, *_ = results.critical[0]
        assert kind == "bifurcation", deck
        rows.append((name, Number(factor, wanted, allowed)))
    problem.compare(rows)
    return problem


PROBLEMS = [lee, williams, column, critical_states]
