"""TRANSIENT: decks of tests/cases/transient."""
import numpy as np

from .kit import Number, Problem

DECKS = "tests/cases/transient"
G = 9.81


class Motion:
    """A run in time: times, places of nodes, energies and momentum by step."""

    def __init__(self, bench, deck, folder=DECKS, **settings):
        self.results = bench.run(f"{folder}/{deck}.deck", **settings)
        self.group = self.results.analysis("transient")
        self.time = self.group["time"][()]

    def of_node(self, name, node):
        """A table of nodes for one of them, by step."""
        table = self.group[f"nodes/{name}"][()]
        return table.reshape(len(self.time), -1, table.shape[-1])[:, self.results.node(node)]

    def place(self, node):
        """Position of a node, by step."""
        return self.of_node("displacement", node) + self.results.position[self.results.node(node)]

    def energy(self, name):
        """One of the energies, by step."""
        return self.group[f"energy/{name}"][()]

    def at(self, time):
        """The step nearest to a time."""
        return int(np.argmin(abs(self.time - time)))


def extrapolated(coarse, fine):
    """What two runs with steps h and h/2 say of h = 0."""
    return (4 * fine - coarse) / 3


def step_force(bench):
    """FLX-01."""
    problem = Problem("FLX-01", "Cantilever with a force from the start on",
                      "series of 39 modes, no shear, no rotary inertia", "closed form")
    problem.text(f"`{DECKS}/step_force.deck`: weak axis of an I, L = 2 m, 100 N, 16 elements, steps"
                 " of 5e-5 s, RHOINF 0.9; deflection of the tip in mm.")
    motion = Motion(bench, "step_force", h=5e-5)
    tip = 1e3 * motion.place(2)[:, 1]
    wanted = {0.005: 0.06600925, 0.01: 0.2203324, 0.02: 0.4391973, 0.03: 0.2639964, 0.05: 0.1759809}
    problem.compare([(f"t = {t:g} s", Number(tip[motion.at(t)], ref, 1e-2))
                     for t, ref in wanted.items()], "tip")
    return problem


def step_torque(bench):
    """FLX-03."""
    problem = Problem("FLX-03", "I beam on forks with a torque from the start on",
                      "series of modes, Vlasov", "closed form")
    problem.text(f"`{DECKS}/step_torque.deck`: L = 3 m, 100 Nm/m at the nodes of 40 elements, steps"
                 " of 5e-5 s; rotation of the middle in mrad, which is back at zero after 25 ms.")
    motion = Motion(bench, "step_torque", n=40, h=5e-5)
    angle = 2e3 * np.arcsin(motion.of_node("euler", 21)[:, 1])
    found = motion.results.analysis("eigen")["frequency"][()]
    wanted = {0.005: 2.1013667, 0.01: 5.5529063, 0.0125: 6.1106302, 0.02: 2.0136356}
    problem.compare([*((f"t = {1e3 * t:g} ms", Number(angle[motion.at(t)], ref, 1e-2))
                       for t, ref in wanted.items()),
                     ("frequency of EIGEN (Hz)",
                      Number(found[np.argmin(abs(found - 40.2313))], 40.231294, 1e-3))])
    return problem


def spin_up(bench):
    """FLX-04."""
    problem = Problem("FLX-04", "Spin-up of a beam",
                      "Kane 1987; Simo and Vu-Quoc, J. Appl. Mech. 53 (1986) 849; another program"
                      " (geometrically exact beam, 16 elements, h = 0.01)",
                      "closed form, other program")
    problem.text(f"`{DECKS}/spin_up.deck`: the hub is driven to 6 rad/s in 15 s, L = 10, 10"
                 " elements, h = 0.01, RHOINF 0.8. The tip seen from the hub; the steady extension"
                 " tan(kL)/k - L is the mean from 16 s to 20 s.")
    motion = Motion(bench, "spin_up")
    t = np.minimum(motion.time, 15)
    angle = 0.4 * (t**2 / 2 + (7.5 / np.pi)**2 * (np.cos(2 * np.pi * t / 15) - 1))
    angle += 6 * (motion.time - t)
    x, y, _ = motion.place(2).T
    along, across = x * np.cos(angle) + y * np.sin(angle) - 10, y * np.cos(angle) - x * np.sin(angle)
    steady = along[motion.time >= 16].mean()
    curve = {2.5: -0.15198, 5: -0.46895, 7.5: -0.55845, 10: -0.36576, 12.5: -0.1138}
    problem.compare([("steady extension", Number(steady, 5.1431746e-4, 2e-3)),
                     ("largest deflection", Number(across.min(), -0.57557, 2e-2)),
                     ("its time", Number(motion.time[across.argmin()], 6.78773, 2e-2)),
                     *((f"deflection at {s} s", Number(across[motion.at(s)], ref, 2e-2))
                       for s, ref in curve.items())])
    return problem


def spaghetti(bench):
    """FLX-05 FLX-10."""
    problem = Problem("FLX-05 FLX-10", "Flying spaghetti: free flight and what it conserves",
                      "Simo and Vu-Quoc 1986; another program (geometrically exact beam, 256"
                      " elements, h = 0.00125); conservation", "other program, closed form")
    problem.text(f"`{DECKS}/spaghetti.deck`: L = 10, 32 elements, h = 0.005, RHOINF 1. Places of"
                 " both ends and the middle; allowed is 1 % of the length, 0.1, at all times. The"
                 " pulse of 8 over 2.5 s leaves the momentum 20. Changes are the largest from 2.5 s"
                 " to 12.5 s.")
    motion = Motion(bench, "spaghetti", h=0.005, end=12.5)
    wanted = {2.5: (4.43013, -0.78514, 5.94529, 8.97066, 5.58869, 3.98125),
              5: (5.6214, 4.76525, 15.41001, 4.26215, 10.47205, 3.60827),
              7.5: (15.5474, 8.99469, 15.75417, -0.97223, 15.51316, 3.99561),
              10: (25.41356, 4.7851, 15.62803, 4.15537, 20.50718, 3.80771)}
    rows, nodes = [], ("1", "2", "1.16")
    for time, ref in wanted.items():
        found = [x for n in nodes for x in motion.place(n)[motion.at(time)][:2]]
        rows.append([f"{time}", *(f"{x:.4f}" for x in found)])
        rows.append(["reference", *(f"{x:.4f}" for x in ref)])
        rows[-2].append(Number(max(abs(a - b) for a, b in zip(found, ref)), 0, 0.1, 3))
        rows[-1].append("")
    problem.table(["t", "end x", "y", "other end x", "y", "middle x", "y", "farthest apart"], rows)
    after = slice(motion.at(2.5), None)
    total = (motion.energy("kinetic") + motion.energy("strain"))[after]
    momentum = motion.group["momentum/linear"][()][after]
    angular = motion.group["momentum/angular"][()][after, 2]
    problem.compare([
        ("momentum at 2.5 s", Number(momentum[0, 0], 20, 1e-6, 9)),
        ("momentum at 12.5 s", Number(momentum[-1, 0], 20, 1e-6, 9)),
        ("largest energy over that at 2.5 s", Number(total.max() / total[0], 1, 1e-4, 7)),
        ("smallest", Number(total.min() / total[0], 1, 1e-4, 7)),
        ("angular momentum at 12.5 s over that at 2.5 s",
         Number(angular[-1] / angular[0], 1, 1e-4, 7))])
    return problem


def pendulum(bench):
    """MBD-01."""
    problem = Problem("MBD-01", "Simple pendulum",
                      "IFToMM benchmark A01; elliptic integrals", "closed form")
    problem.text(f"`{DECKS}/pendulum.deck`: point mass at a rigid bar, released horizontally,"
                 " RHOINF 0.9, extrapolated from h = 0.001 and 0.0005 (the error goes with h²).")
    runs = [Motion(bench, "pendulum", h=h, rho=0.9) for h in (1e-3, 5e-4)]
    wanted = {1: (0.98629175, -0.16501085), 2: (-0.79356620, -0.60848393),
              5: (-0.94230544, -0.33475434), 10: (-0.27508746, -0.96141921)}
    rows = []
    for time, ref in wanted.items():
        place = extrapolated(*(run.place(2)[run.at(time)] for run in runs))
        rows += [(f"{axis}({time} s)", Number(place[i], ref[i], 1e-4))
                 for i, axis in enumerate("xy")]
    problem.compare(rows)
    drift = [abs(run.energy("imbalance")).max() / G for run in runs]
    problem.compare([("energy lost in 10 s, of m g L, h = 0.0005", Number(drift[1], 0, 1e-4, 2))])
    return problem


def double_pendulum(bench):
    """MBD-03."""
    problem = Problem("MBD-03", "Double pendulum of point masses",
                      "ordinary differential equations by DOP853", "exact solution")
    problem.text(f"`{DECKS}/double_pendulum.deck`: both bars horizontal at the start, RHOINF 0.9,"
                 " extrapolated from h = 0.001 and 0.0005.")
    runs = [Motion(bench, "double_pendulum", h=h, rho=0.9) for h in (1e-3, 5e-4)]
    wanted = {0.5: (0.540029409, -0.841646147, 1.47346567, -1.20038944),
              1: (-0.585168392, -0.810911803, -1.44481885, -1.32179446),
              2: (-0.464412868, -0.885618816, -1.43413482, -1.12987020),
              3: (0.976976566, 0.213346642, 1.87625085, -0.224038498)}
    rows = []
    for time, ref in wanted.items():
        found = [extrapolated(*(run.place(n)[run.at(time)] for run in runs))[i]
                 for n in (2, 3) for i in (0, 1)]
        rows += [(f"{name}({time:g} s)", Number(x, y, 1e-3))
                 for name, x, y in zip(("x1", "y1", "x2", "y2"), found, ref)]
    problem.compare(rows)
    return problem


def bricard(bench):
    """MBD-11."""
    problem = Problem("MBD-11", "Bricard's mechanism, overconstrained",
                      "IFToMM benchmark; conservation of energy, as no history is published",
                      "closed form")
    problem.text(f"`{DECKS}/bricard.deck`: six hinges, five rods of 1 m and 1 kg, h = 0.005, RHOINF"
                 " 0.9, 10 s. One hinge holds once more than it need; spar says so and goes on. The"
                 " mechanism comes back to where it started.")
    motion = Motion(bench, "bricard", h=0.005)
    place = motion.place(4)
    problem.compare([
        ("energy lost, of the largest kinetic energy",
         Number(abs(motion.energy("imbalance")).max() / motion.energy("kinetic").max(), 0, 1e-3,
                2)),
        ("largest way of node 4 along x (m)", Number(1 - place[:, 0].min(), 2, 1e-4))])
    return problem


def free_body(bench):
    """MBD-04."""
    problem = Problem("MBD-04", "Free rigid body near its intermediate axis",
                      "Jacobi's elliptic functions", "closed form")
    problem.text(f"`{DECKS}/free_body.deck`: J = (1, 2, 3), first angular velocity (0.1, 2, 0.1),"
                 " RHOINF 1, extrapolated from h = 0.01 and 0.005; angular velocity in the body.")
    runs = [Motion(bench, "free_body", h=h) for h in (0.01, 0.005)]
    wanted = {1: (-0.073263308, 2.00115779, 0.091955628), 2: (-0.35351428, 1.97104735, 0.21982747),
              5: (-1.20677422, -1.59802878, 0.70149935), 10: (1.10506663, -1.66997836, 0.64321387)}
    rows = []
    for time, ref in wanted.items():
        found = extrapolated(*(body_rates(run)[run.at(time)] for run in runs))
        rows += [(f"ω{axis}({time} s)", Number(x, y, 1e-4))
                 for axis, x, y in zip("xyz", found, ref)]
    problem.compare(rows)
    return problem


def body_rates(motion):
    """Angular velocity of node 1 in its own axes, by step."""
    e, spin = motion.of_node("euler", 1), motion.of_node("angular_velocity", 1)
    back = 2 * np.cross(-e[:, 1:], spin)
    return spin + e[:, :1] * back + np.cross(-e[:, 1:], back)


def top(bench):
    """MBD-06."""
    problem = Problem("MBD-06", "Top in steady precession",
                      "mgl = Ia (ψ' + w cos θ) w - It w² cos θ", "closed form")
    problem.text(f"`{DECKS}/top.deck`: Ia = 0.46875, It = 15.234375, mgl = 147.15, spin 150 rad/s,"
                 " started with its precession w; h = 0.00025, RHOINF 0.9; w found after 0.5 s.")
    rows = []
    for theta, rate in ((90, 2.0928), (60, 3.105309340559323), (60, 6.418500183250199)):
        motion = Motion(bench, "top", theta=theta, w=rate, h=2.5e-4, end=0.5)
        x, y, _ = motion.place(2)[-1]
        rows.append((f"w at θ = {theta}°", Number(np.arctan2(y, x) % (2 * np.pi) / 0.5, rate, 1e-4)))
    problem.compare(rows)
    return problem


def slider_crank(bench):
    """MBD-13."""
    problem = Problem("MBD-13", "Spatial slider-crank",
                      "IFToMM benchmark, Haug 1989: first place and velocity of the slider",
                      "published, closed form")
    problem.text(f"`{DECKS}/slider_crank.deck`: crank at 6 rad/s, ball joint, rod, universal joint,"
                 " slider; h = 0.0005, 1 s.")
    motion = Motion(bench, "slider_crank", h=5e-4)
    first = motion.of_node("velocity", 3)[0, 0]
    problem.compare([
        ("first place of the slider (m)", Number(motion.place(3)[0, 0], 0.2, 1e-6)),
        ("its first velocity (m/s)", Number(first, 0.24, 1e-4)),
        ("energy missing, of the first kinetic energy",
         Number(abs(motion.energy("imbalance")).max() / motion.energy("kinetic")[0], 0, 2e-3,
                2))])
    return problem


PROBLEMS = [step_force, step_torque, spin_up, spaghetti, pendulum, double_pendulum, bricard]

# These start with velocities (STARTDX, STARTDE).
FROM_VELOCITIES = [free_body, top, slider_crank]
