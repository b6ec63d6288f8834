"""Closed forms.

Columns on forks: a sine of n half waves turns the equations of the beam into algebra.
"""
import numpy as np

# The column of the paper's tables 1 to 3 in kN, mm; density in kN s2/mm4 (not printed there).
COLUMN = {"E": 144.0, "G": 4.14, "A": 5.4e4, "IY": 3.78e9, "IZ": 2.16e9, "IT": 1.62e7,
          "IW": 1.3886e14, "YS": 457.1, "L": 6000.0, "RHO": 1.389e-12}
TABLE_1 = {"DY": 2.79e4, "DZ": 1.58e4, "DW": 3.65e9, "DZW": -3.7e6}
SHEAR_FLOW = {"DY": 2.769231e4, "DZ": 1.598901e4, "DW": 3.693654e9, "DZW": -3.814757e6}


def coupled_matrices(column, shear, waves, rotary=True, warping=True):
    """Stiffness, load (unit compression at the centroid) and mass of the coupled sine modes.

    Unknowns: deflection of the centroid, twist, rotation of the section, warping; a rigid shear
    leaves the first two. Per L/2; `shear` holds DZ, DW, DZW or is None.
    """
    c = column
    k = waves * np.pi / c["L"]
    polar = c["IY"] + c["IZ"]
    # Rows: strains as coefficients of (w, phi, psi, alpha); w_s = w + ys phi.
    if shear is None:
        bend = np.array([[k**2, c["YS"] * k**2], [0, k**2]])
        stiffness = bend.T @ np.diag([c["E"] * c["IY"], c["E"] * c["IW"]]) @ bend
        rotate = np.array([[k, c["YS"] * k], [0, k]])
        twist = np.array([[0, k]])
        move = np.eye(2)
    else:
        bend = np.array([[0, 0, k, 0], [0, 0, 0, k]])
        strain = np.array([[k, c["YS"] * k, -1, 0], [0, k, 0, -1]])
        rigidity = c["G"] * np.array([[shear["DZ"], shear["DZW"]], [shear["DZW"], shear["DW"]]])
        stiffness = (bend.T @ np.diag([c["E"] * c["IY"], c["E"] * c["IW"]]) @ bend
                     + strain.T @ rigidity @ strain)
        rotate = np.array([[0, 0, 1, 0], [0, 0, 0, 1]])
        twist = np.array([[0, k, 0, 0]])
        move = np.eye(2, 4)
    stiffness = stiffness + c["G"] * c["IT"] * twist.T @ twist
    load = k**2 * move.T @ np.diag([1, polar / c["A"]]) @ move
    mass = c["RHO"] * (move.T @ np.diag([c["A"], polar]) @ move + rotate.T @ np.diag(
        [c["IY"] * rotary, c["IW"] * warping]) @ rotate)
    return stiffness, load, mass


def eigenvalues(stiffness, other):
    """Finite eigenvalues of stiffness x = value other x, in rising order."""
    values = np.linalg.eigvals(np.linalg.solve(stiffness, other)).real
    return np.sort(1 / values[values > 1e-12 * abs(values).max()])


def buckling_load(column, shear):
    """Smallest flexural-torsional buckling load."""
    stiffness, load, _ = coupled_matrices(column, shear, 1)
    return eigenvalues(stiffness, load)[0]


def frequencies(column, shear, count, rotary=True, warping=True):
    """The lowest frequencies, flexural-torsional ones and those of bending about z."""
    found = []
    for waves in range(1, count + 1):
        stiffness, _, mass = coupled_matrices(column, shear, waves, rotary, warping)
        found += list(eigenvalues(stiffness, mass)[:2])
        found.append(bending_eigenvalue(column, shear, waves, rotary))
    return np.sort(np.sqrt(found))[:count] / (2 * np.pi)


def bending_eigenvalue(column, shear, waves, rotary):
    """Square of the lower circular frequency of bending about z."""
    c = column
    k = waves * np.pi / c["L"]
    rigidity, inertia = c["E"] * c["IZ"], c["RHO"] * c["IZ"] * rotary
    if shear is None:
        return rigidity * k**4 / (c["RHO"] * c["A"] + inertia * k**2)
    stiff = c["G"] * shear["DY"]
    stiffness = np.array([[stiff * k**2, -stiff * k], [-stiff * k, stiff + rigidity * k**2]])
    return eigenvalues(stiffness, np.diag([c["RHO"] * c["A"], inertia]))[0]


def elliptic(k):
    """Complete elliptic integrals K and E of the modulus k, by the arithmetic-geometric mean."""
    a, b, c, total, power = 1.0, np.sqrt(1 - k * k), k, k * k / 2, 0.5
    while abs(c) > 1e-16:
        a, b, c = (a + b) / 2, np.sqrt(a * b), (a - b) / 2
        power *= 2
        total += power * c * c
    integral = np.pi / (2 * a)
    return integral, integral * (1 - total)
