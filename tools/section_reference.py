#!/usr/bin/env python3
"""Write tests/reference/sections_fe.json: sections solved by finite elements.

    tools/section_reference.py [OUT]     needs the PyPI package sectionproperties==3.10.2

Five thin open sections and, for It and Iw only, a solid rectangle and a box. Each is drawn with
its full corners (every plate runs on by half the thickness of the plate it meets at an end corner)
and meshed with quadratic triangles, some four across the thinnest wall. What thin-wall theory of
the midline leaves out, and so the tolerances, with r the largest t/b of a plate and of the section:

    A            the overlap tw t/2 at a tee, nothing at a corner (1e-6 for the mesh)
    Iy, Iz       t**3/12 of each wall and the corners' shift: (t/b)**2, up to r**2
    It           a free end takes 0.105 t**4, a corner or tee adds 0.1 to 0.3 t**4 to b t**3/3: r
    Iw           warping across the wall, b**3 t**3/144, and the moments' errors: up to 4 r**2
    ys, zs       of the section's height: r**2
    RECT         exact series: 1e-4, the mesh's
    BOX          Iw goes with (b/t - h/tw)**2 and the corners change each of these by about 1:
                 2/|b/t - h/tw| = 0.013; It less
"""

import json
import sys
from pathlib import Path

from sectionproperties.analysis import Section
from sectionproperties.pre import Geometry
from shapely.geometry import box
from shapely.ops import unary_union

VERSION = "3.10.2"
OUT = Path(__file__).resolve().parent.parent / "tests/reference/sections_fe.json"

# name: points, plates (from 1) and thicknesses
SECTIONS = {
    "C600": ([(600, 300), (0, 300), (0, -300), (600, -300)],
             [(1, 2), (2, 3), (3, 4)], [30, 30, 30]),
    "U300": ([(9.5, 14.2), (0, 14.2), (0, -14.2), (9.5, -14.2)],
             [(1, 2), (2, 3), (3, 4)], [1.6, 1.0, 1.6]),
    "Z, unequal flanges": ([(-80, 100), (0, 100), (0, -100), (60, -100)],
                           [(1, 2), (2, 3), (3, 4)], [4, 3, 5]),
    "I, unequal flanges": ([(-100, 300), (0, 300), (100, 300), (-50, 0), (0, 0), (50, 0)],
                           [(1, 2), (2, 3), (2, 5), (4, 5), (5, 6)], [10, 10, 5, 10, 10]),
    "C with lips": ([(70, 200), (0, 200), (0, 0), (70, 0), (70, 180), (70, 20)],
                    [(1, 2), (2, 3), (3, 4), (1, 5), (4, 6)], [2, 2, 2, 2, 2]),
}


# name: outer sizes along z and y, wall thickness along y and z (0: solid), tolerance
CELLS = {"RECT": (100, 60, 0, 0, 1e-4), "BOX": (200, 100, 2, 1, 0.013)}


def polygon(points, plates, thickness):
    """The union of all plates, each run on to fill the corner at an end it shares with one."""
    parts = []
    for (i, j), t in zip(plates, thickness):
        (y1, z1), (y2, z2) = points[i - 1], points[j - 1]
        on = [0.0, 0.0]
        for end, k in enumerate((i, j)):
            others = [u for p, u in zip(plates, thickness) if k in p and p != (i, j)]
            if len(others) == 1:
                on[end] = others[0] / 2
        if z1 == z2:
            sign = 1 if y2 > y1 else -1
            a, b = sorted((y1 - sign * on[0], y2 + sign * on[1]))
            parts.append(box(a, z1 - t / 2, b, z1 + t / 2))
        else:
            sign = 1 if z2 > z1 else -1
            a, b = sorted((z1 - sign * on[0], z2 + sign * on[1]))
            parts.append(box(y1 - t / 2, a, y1 + t / 2, b))
    return unary_union(parts)


def solved(shape, element_area):
    geometry = Geometry(shape)
    geometry.create_mesh(mesh_sizes=[element_area])
    section = Section(geometry)
    section.calculate_geometric_properties()
    section.calculate_warping_properties()
    return section


def solve_cell(h, b, t, tw, tolerance):
    shape = box(0, 0, b, h)
    if t:
        shape = shape.difference(box(tw, t, b - tw, h - t))
    section = solved(shape, (t / 3.5) ** 2 if t else h * b / 3000)
    return {"size": [h, b, t, tw], "It": section.get_j(), "Iw": section.get_gamma(),
            "tolerance": tolerance}


def solve(points, plates, thickness):
    """Area, principal moments, torsion and warping constants, shear centre (drawn axes)."""
    section = solved(polygon(points, plates, thickness), (min(thickness) / 4.5) ** 2)
    i11, i22 = section.get_ip()[:2]
    return {"A": section.get_area(), "I": sorted((i11, i22), reverse=True), "It": section.get_j(),
            "Iw": section.get_gamma(), "centroid": list(section.get_c()),
            "shear_centre": list(section.get_sc())}


def tolerances(points, plates, thickness):
    """Relative ones; of the shear centre, in parts of the section's height.

    At a tee the thinnest plate is taken for the one that ends there.
    """
    lengths = [abs(points[i - 1][0] - points[j - 1][0]) + abs(points[i - 1][1] - points[j - 1][1])
               for i, j in plates]
    r = max(t / b for t, b in zip(thickness, lengths))
    area = sum(t * b for t, b in zip(thickness, lengths))
    overlap = 0.0
    for k in range(1, len(points) + 1):
        met = sorted(t for p, t in zip(plates, thickness) if k in p)
        if len(met) == 3:
            overlap += met[0] * met[1] / 2
    return {"A": overlap / (area - overlap) + 1e-6, "I": r ** 2, "It": r, "Iw": 4 * r ** 2,
            "shear_centre": r ** 2}


def rounded(value):
    if isinstance(value, str):
        return value
    if isinstance(value, dict):
        return {k: rounded(v) for k, v in value.items()}
    if isinstance(value, list):
        return [rounded(v) for v in value]
    return float(f"{value:.9g}")


def main(arguments):
    out = Path(arguments[0]) if arguments else OUT
    sections = []
    for name, (points, plates, thickness) in SECTIONS.items():
        sections.append({"name": name, "points": points, "plates": plates, "thickness": thickness,
                         **rounded(solve(points, plates, thickness)),
                         "tolerance": rounded(tolerances(points, plates, thickness))})
    lines = ",\n".join(json.dumps(s) for s in sections)
    cells = ",\n".join(json.dumps(rounded({"name": name, **solve_cell(*sizes)}))
                       for name, sizes in CELLS.items())
    out.write_text('{"about": "finite elements, sectionproperties ' + VERSION
                   + '; see tools/section_reference.py",\n"sections": [\n' + lines
                   + '],\n"cells": [\n' + cells + "]}\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
