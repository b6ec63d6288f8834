"""Leaf-spring mechanisms: decks of tests/cases/static, references of tools/flexure_reference.py."""
import numpy as np

from .kit import Number, Problem

E, NU, LENGTH, HEIGHT, THICKNESS = 210000.0, 0.3, 100.0, 50.0, 0.5
AREA, BENDING = HEIGHT * THICKNESS, HEIGHT * THICKNESS**3 / 12

# Stroke, force, compliance along the springs, across them, stroke held.
GUIDE = np.array([
    [2.5, 6.5649975, 1.36197566e-05, 0.000341598079],
    [5, 13.1519753, 2.59454796e-05, 0.000821513471],
    [7.5, 19.7831494, 4.66181053e-05, 0.001620221],
    [10, 26.4812117, 7.58347814e-05, 0.00273593637],
    [12.5, 33.26958, 0.000113874767, 0.00416611169],
    [15, 40.1726613, 0.000161112233, 0.00590737599],
    [17.5, 47.216136, 0.0002180218, 0.00795545919],
    [20, 54.4272673, 0.000285191466, 0.0103050971]])
# Angle in degrees, moment, drift of the pivot in y, compliances in x, y, z, angle held.
CROSS = np.array([
    [2.5, 95.4779668, 0.0224273782, 4.32459982e-05, 4.32131875e-05, 7.517133e-05],
    [5, 191.137332, 0.0895985756, 0.000115966363, 0.000115615335, 9.92026761e-05],
    [7.5, 287.158291, 0.201181514, 0.000237578574, 0.000235972359, 0.000140025632],
    [10, 383.71866, 0.356625165, 0.00040868967, 0.000403829704, 0.000198791117],
    [12.5, 480.992737, 0.555163159, 0.000630132515, 0.000618580898, 0.000277099561],
    [15, 579.15025, 0.795818764, 0.000902932973, 0.000879489113, 0.000376988818],
    [17.5, 678.355369, 1.07741115, 0.00122830945, 0.00118573711, 0.000500917009],
    [20, 778.765842, 1.39856288, 0.00160761778, 0.00153645614, 0.00065173931]])


def compliances(results):
    """Of the only node, by step."""
    return results.analysis()["compliance/matrix"][()].reshape(-1, 6, 6)


def reactions(results, column):
    """Of the body, by step."""
    return results.stacked(results.analysis(), "nodes/reaction")[:, results.node(5), column]


def guide(bench):
    """LEAF-01."""
    problem = Problem("LEAF-01", "Parallel leaf-spring guide: support stiffness over the stroke",
                      "second-order beam; leaf springs integrated without elements"
                      " (`tools/flexure_reference.py`)", "closed form, exact solution")
    deck = "tests/cases/static/leaf_guide.deck"
    problem.text(
        f"`{deck}`: leaf springs 100×50×0.5 mm, 50 mm apart, E = 210 GPa, a rigid shuttle moved"
        " across them by ±20 mm (one side computed), 32 elements for each spring. Compliances are"
        " those of the tangent with the stroke held (option COMPLIANCE of STATIC). Beams are"
        " narrow: a wide leaf spring, held from curving across by its clamps, has up to"
        " 1/(1 - ν²), 10 %, more bending stiffness; give it E/(1 - ν²) if that matters.")
    small = bench.run(deck, stroke="0.01")
    shear = 10 * (1 + NU) / (12 + 11 * NU)
    wide = LENGTH**3 / (E * HEIGHT**3 * THICKNESS / 4) + LENGTH * 2 * (1 + NU) / (E * AREA * shear)
    first = compliances(small)[-1]
    problem.compare([
        ("guiding stiffness, 24EI/L³ (N/mm)",
         Number(reactions(small, 1)[-1] / 0.01, 24 * E * BENDING / LENGTH**3, 5e-4)),
        ("along the springs, 2EA/L (N/mm)", Number(1 / first[0, 0], 2 * E * AREA / LENGTH, 1e-3)),
        ("across, two cantilevers (N/mm)", Number(1 / first[2, 2], 2 / wide, 1e-3))])
    fine, coarse = bench.run(deck, n=32), bench.run(deck, n=16)
    force, c = reactions(fine, 1), compliances(fine)
    extrapolated = (4 * c[:, 2, 2] - compliances(coarse)[:, 2, 2]) / 3
    rows = [[f"{row[0]:g}", Number(f, row[1], 1e-4), f"{row[1]:.6g}",
             Number(1 / m[0, 0], 1 / row[2], 1e-3), f"{1 / row[2]:.6g}",
             Number(1 / m[2, 2], 1 / row[3], 7e-3), Number(1 / x, 1 / row[3], 1e-3),
             f"{1 / row[3]:.6g}"]
            for row, f, m, x in zip(GUIDE, force, c, extrapolated)]
    problem.text("Deflected, against the leaf springs integrated: the force is allowed 1e-4, the"
                 " stiffness along the springs 1e-3. The torsion that a force across the guide"
                 " brings varies along the springs and is constant in an element: 4.7/n² of its"
                 " share is lost, 0.5 % here (allowed 7e-3); extrapolated from 16 and 32 elements"
                 " 1e-3 are allowed.")
    problem.table(["stroke (mm)", "force (N)", "exact", "along (N/mm)", "exact", "across",
                   "across, extrapolated", "exact"], rows)
    closed = LENGTH / (2 * E * AREA) * (1 + GUIDE[:, 0]**2 * AREA / (700 * BENDING))
    drop = [Number(m[0, 0], x, 0.06) for m, x in zip(c, closed)]
    warped = bench.run("tests/cases/static/leaf_guide_warping.deck", n=32)
    factor = c[-1, 2, 2] / compliances(warped)[-1, 2, 2]
    problem.text(
        "In closed form the second-order beam has, along the springs with the stroke v held,"
        " c = L/(2EA) (1 + v² A/(700 I)): at 20 mm the support stiffness is 1/28 of that at rest."
        f" spar is {100 * drop[0].error:.1f} % from it at 2.5 mm, {100 * drop[-1].error:.1f} % at"
        " 20 mm, where the shuttle tilts and the slopes are no longer small (allowed 6 %)."
        " A BEAMW whose warping is held at the clamps (FIX ... W) resists torsion better: across"
        f" the springs the guide is {factor:.2f} times as stiff at 20 mm, along them the same.")
    problem.numbers += drop
    problem.picture("leaf_guide.png", "Parallel guide: support stiffness over the stroke, shapes",
                    "leaf_guide", fine, c, compliances(warped), GUIDE,
                    (LENGTH / (2 * E * AREA), AREA / (700 * BENDING)))
    return problem


def cross_hinge(bench):
    """LEAF-02."""
    problem = Problem("LEAF-02", "Cross-hinge: moment, drift and support stiffness",
                      "2EI/L; leaf springs integrated without elements"
                      " (`tools/flexure_reference.py`)", "closed form, exact solution")
    deck = "tests/cases/static/cross_hinge.deck"
    problem.text(f"`{deck}`: two leaf springs 100×50×0.5 mm that cross at their middles at right"
                 " angles, the platform turned by INPUTX to 20 degrees, 32 elements for each"
                 " spring; the point that was at the crossing, compliances with the angle held.")
    small = bench.run(deck, angle="1e-3")
    problem.compare([("rotational stiffness, 2EI/L (N mm)", Number(
        reactions(small, 5)[-1] / 1e-3, 2 * E * BENDING / LENGTH, 1e-4))])
    results = bench.run(deck, n=32)
    moment, c = reactions(results, 5), compliances(results)
    drift = results.series(results.analysis(), "nodes/5/Y")
    problem.table(
        ["angle", "moment (N mm)", "exact", "drift (mm)", "exact", "x (N/mm)", "exact", "z (N/mm)",
         "exact"],
        [[f"{row[0]:g}°", Number(m, row[1], 1e-4), f"{row[1]:.6g}",
          Number(d, row[2], 1e-4), f"{row[2]:.6g}", Number(1 / k[0, 0], 1 / row[3], 1e-3),
          f"{1 / row[3]:.6g}", Number(1 / k[2, 2], 1 / row[5], 7e-3), f"{1 / row[5]:.6g}"]
         for row, m, d, k in zip(CROSS, moment, drift, c)])
    rigid = bench.run("tests/cases/static/cross_hinge_rigid.deck", n=32)
    released = bench.run("tests/cases/static/cross_hinge_released.deck", n=32)
    problem.text(
        "Allowed: 1e-4 of moment and drift, 1e-3 and, for the torsion in z, 7e-3 of the stiffness."
        " With springs that only bend in the plane and twist (`cross_hinge_rigid.deck`, DYNE 2 5 6)"
        " there is one constraint too many: `spar check` says so. With one end released in the"
        " stiff plane (`cross_hinge_released.deck`, RLSE 2.1 3) there is none. A motion in the"
        " plane does not feel the difference:")
    exact = CROSS[-1, 1]
    problem.compare([
        ("moment at 20°, overconstrained", Number(reactions(rigid, 5)[-1], exact, 1e-3)),
        ("moment at 20°, released", Number(reactions(released, 5)[-1], exact, 1e-3))])
    problem.picture("cross_hinge.png", "Cross-hinge: support stiffness over the angle, shapes",
                    "cross_hinge", results, c, CROSS)
    return problem


PROBLEMS = [guide, cross_hinge]
