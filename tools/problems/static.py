"""Large displacements and small: decks of tests/cases/static."""
import numpy as np

from .kit import Number, Problem, short

# Load PL2/EI, w/L, u/L, theta of the elastica: elliptic integrals (Mattiasson 1981).
ELASTICA = np.array([
    [0.2, 0.06636448, 0.002646548, 0.09963616], [0.4, 0.1309752, 0.01035392, 0.1971546],
    [0.6, 0.1923503, 0.02248767, 0.2907377], [0.8, 0.2494515, 0.03816561, 0.3790630],
    [1, 0.3017208, 0.05643324, 0.4613520], [1.5, 0.4109782, 0.1079415, 0.6395398],
    [2, 0.4934575, 0.1606417, 0.7817498], [3, 0.6032534, 0.2544202, 0.9860169],
    [4, 0.6699642, 0.3289412, 1.121239], [5, 0.7137915, 0.3876284, 1.215368],
    [6, 0.7445712, 0.4345888, 1.283697], [7, 0.7673691, 0.4729274, 1.334960],
    [8, 0.7849824, 0.5048277, 1.374432], [9, 0.7990555, 0.5318206, 1.405465],
    [10, 0.8106090, 0.5549956, 1.430286]])


def elastica(bench):
    """STA-01."""
    problem = Problem("STA-01", "Elastica: cantilever with a transverse dead load",
                      "Bisshopp and Drucker 1945; Mattiasson, IJNME 17 (1981) 145", "closed form")
    results = bench.run("tests/cases/static/elastica.deck")
    parts = [results.analysis(name) for name in ("1", "2", "3")]
    w, u, angle = (np.concatenate([results.series(part, path) for part in parts]) for path in (
        "nodes/2/Z", "-nodes/2/X", "nodes/2/angle"))
    problem.text("`tests/cases/static/elastica.deck`: 16 elements; deflection w, shortening u and"
                 " rotation θ of the tip over the load. The axial stiffness is finite (stretch 1e-5"
                 " of the length), the closed form has none. Allowed: 1e-4 of each.")
    rows = []
    for row, got in zip(ELASTICA, zip(w, u, angle)):
        numbers = [Number(x, ref, 1e-4) for x, ref in zip(got, row[1:])]
        worst = max(numbers, key=lambda n: abs(n.error))
        rows.append([f"{row[0]:g}", *numbers, short(worst.error)])
    problem.table(["PL²/EI", "w/L", "u/L", "θ", "largest error"], rows)
    problem.picture("elastica.png", "Elastica: shapes, and tip against load",
                    "elastica", results, parts, (w, u, angle), ELASTICA)
    return problem


def roll_up(bench):
    """STA-02."""
    problem = Problem("STA-02", "Roll-up by an end moment",
                      "constant curvature; error law by hand", "closed form")
    meshes = [4, 8, 16, 32]
    computed, law, circle = [], [], []
    for n in meshes:
        results = bench.run("tests/cases/static/rollup.deck", n=n)
        tip = results.stacked(results.analysis(), "nodes/displacement")[:, results.node(2)]
        computed.append(np.linalg.norm(tip[4] - [-1, 0, 2 / np.pi]) * np.pi / 2)
        circle.append(np.linalg.norm(tip[9] - [-1, 0, 0]))
        half = np.pi / n / 2
        law.append(1 - (1 - half**2 / 6) * half / np.sin(half))
    problem.text("`tests/cases/static/rollup.deck`, n elements, ten steps to a full circle, which"
                 " closes to 1e-9 of the length by symmetry. The half circle shows what the element"
                 " leaves out: bent by an angle a it takes 1 - a²/24 for the chord over the arc,"
                 " not sin(a/2)/(a/2), which is a⁴/1920 too short. The distance of the tip from its"
                 " place, over the tip's height 2L/π, has to follow that law (reference).")
    problem.compare([(f"half circle, n = {n}", Number(x, ref, 1e-3, 4))
                     for n, x, ref in zip(meshes, computed, law)])
    problem.numbers += [Number(1 + x, 1, 1e-9) for x in circle]
    problem.picture("rollup.png", "Roll-up: error of the half circle over the number of elements",
                    "roll_up", bench.run("tests/cases/static/rollup.deck", n=16), meshes, computed)
    return problem


def reissner(bench):
    """STA-05."""
    problem = Problem("STA-05", "Thick cantilever, flexible in shear and axially",
                      "exact boundary-value problem of Reissner's beam; Nachbagauer, Pechstein,"
                      " Irschik and Gerstmayr 2011", "exact solution")
    deck = "tests/cases/static/reissner.deck"
    problem.text(
        f"`{deck}`: L = 2 m, h = 0.5 m, 40 elements, shear on. Exudyn prints for 1024 elements"
        " u = 0.15097102, w = 0.71056836 m at the large load.",
        "What remains does not vanish with the mesh: the element takes the axial force along the"
        " tangent of the axis (Engesser), Reissner's beam along the normal of the section"
        " (Haringx). To second order in the load this makes u larger by γ²L/2 - F²L/(GA EA), with"
        " γ = F/GA; the last line has that added to the reference.")
    rows = []
    for f, wanted in (("62.5e6", (0.15097114, 0.71056860, 0.52017317)),
                      ("62500", (1.8884916e-7, 8.0990325e-4, 5.7971007e-4))):
        results = bench.run(deck, f=f)
        last = results.analysis()
        load = "62.5 MN" if f == "62.5e6" else "62.5 kN"
        got = [results.series(last, path)[-1]
               for path in ("-nodes/2/X", "nodes/2/Z", "nodes/2/angle")]
        rows += [(f"{name}, {load}", Number(x, ref, 1e-3))
                 for name, x, ref in zip(("u (m)", "w (m)", "θ (rad)"), got, wanted)]
    more = 2 * 62500**2 / 3382352941 * (1 / (2 * 3382352941) - 1 / 10.35e9)
    rows.append(("u (m), 62.5 kN, Engesser", Number(got[0], wanted[0] + more, 1e-5)))
    problem.compare(rows)
    return problem


def bend(bench):
    """STA-07."""
    problem = Problem("STA-07", "45° bend: large bending and torsion in space",
                      "exact Reissner beam by shooting, torsion constant 0.14058; Bathe and"
                      " Bolourchi, IJNME 14 (1979) 961", "exact solution")
    deck = "tests/cases/static/bend45.deck"
    exact = {300: (58.535933, 22.112615, 40.480262), 600: (46.891925, 15.557786, 53.607369)}
    meshes = [8, 16, 32]
    errors, rows = {300: [], 600: []}, []
    for n in meshes:
        results = bench.run(deck, n=n)
        tip = results.node(n + 1)
        move = results.stacked(results.analysis(), "nodes/displacement")[:, tip]
        for load, wanted in exact.items():
            got = results.position[tip] + move[load // 100 - 1]
            numbers = [Number(x, ref, 6e-3 * (8 / n)**2) for x, ref in zip(got, wanted)]
            errors[load].append(np.linalg.norm(got - wanted) / np.linalg.norm(wanted))
            rows.append([f"{load}, {n}", *numbers, short(max(
                (m.error for m in numbers), key=abs)), short(numbers[0].allowed)])
    for load, wanted in exact.items():
        rows.append([f"{load}, exact", *(f"{x:.6g}" for x in wanted), "", ""])
    problem.text(f"`{deck}`: R = 100, the bend as a polygon of n straight elements: its distance"
                 " from the arc is the error, which falls with n². Published for eight elements:"
                 " Simo and Vu-Quoc 58.84, 22.33, 40.08 (300) and 47.23, 15.79, 53.37 (600), Bathe"
                 " and Bolourchi 47.2, 15.9, 53.4 (600), with a torsion constant of 1/6.")
    problem.table(["load, elements", "x of the tip", "y", "z", "largest error", "allowed"], rows)
    return problem


def torsion(bench):
    """STA-13."""
    problem = Problem("STA-13", "Non-uniform torsion with bimoment",
                      "hyperbolic functions, Vlasov and with shear of warping", "closed form")
    deck = "tests/cases/static/torsion.deck"
    problem.text(f"`{deck}`: I beam clamped with its warping, L = 3 m, kL = 1.97, tip torque 1000 N"
                 " m scaled by 1e-6 to stay linear (values per 1000 N m); 16 elements.")
    exact = {"OFF": (0.14299338, 0.067643679, 1462.1116, 478.42808, 0.048007279),
             "ON": (0.14319147, 0.067582768, 1459.9812, 478.18180, 0.048182467)}
    names = ("twist at the tip (rad)", "warping at the tip (1/m)", "bimoment of the clamp (N m²)",
             "bimoment in the middle (N m²)", "twist in the middle (rad)")
    rows = []
    for shear, wanted in exact.items():
        results = bench.run(deck, shear=shear)
        group = results.analysis()
        part = results.file["model/elements/part"][()]
        element = results.file["model/elements/id"][()]
        force = group["elements/section_force_p"][()]
        row = [int(np.flatnonzero((element == k) & (part == 1))[0]) for k in (1, 2)]
        twist_tip, warping_tip, twist_middle = (results.series(group, f"nodes/{path}")[0]
                                                for path in ("3/angle", "3/warping", "2/angle"))
        got = (twist_tip, warping_tip, force[row[0], 6], force[row[1], 6], twist_middle)
        theory = "Vlasov" if shear == "OFF" else "with shear"
        rows += [(f"{theory}: {name}", Number(1e6 * x, ref, 1e-4))
                 for name, x, ref in zip(names, got, wanted)]
    problem.compare(rows)
    return problem


def small_channel(bench):
    """STA-16."""
    problem = Problem("STA-16", "Channel cantilever, small load through the web",
                      "beam theory: PL³/(3EI) + PL/(GD), twist with restrained warping",
                      "closed form")
    deck = "tests/cases/static/channel.deck"
    problem.text(f"`{deck}` with f = 1e-6 kN, z = 0, shear on: the paper's Fig. 11. The load passes"
                 " 3.622 cm beside the shear centre. The closed form has neither shear of warping"
                 " nor its coupling with bending.")
    results = bench.run(deck, f="1e-6", z=0, shear="ON")
    group = results.analysis()
    euler = results.stacked(group, "nodes/euler")[0, results.node(2)]
    problem.compare([
        ("deflection of the shear centre per kN (cm)",
         Number(-1e6 * results.series(group, "markers/S/Z")[0], 1.4436183, 1e-3)),
        ("twist per kN (rad)", Number(-2e6 * euler[1], 0.010434249, 1e-3))])
    return problem


PROBLEMS = [elastica, roll_up, reissner, bend, torsion, small_channel]
