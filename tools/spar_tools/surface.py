"""Spatial pictures of deformed models and modes from /VTKHDF of a result file; needs pyvista."""
import os
import sys

import numpy as np

from .results import ResultError

SIZE = (1200, 800)
INK, PALE = "#1a1a1a", "#b4b4b4"
FIELDS = {"axial_stress": "axial stress", "displacement": "displacement", "rotation": "rotation"}


def import_pyvista():
    """pyvista, told to draw without a window where there is no display."""
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    try:
        import pyvista
    except ImportError:
        raise ResultError("spatial pictures need pyvista: pip install pyvista") from None
    return pyvista


def drawn_steps(results, group, rows):
    """Numbers of the steps in /VTKHDF of states or modes of an analysis, rows from 0."""
    if "VTKHDF" not in results.file:
        raise ResultError(f"{results.path} has no drawing: it was run with --no-vtk")
    number = int(group.name.rsplit("/", 1)[-1].partition("_")[0])
    origin = [tuple(row) for row in results.file["VTKHDF/Steps/Origin"][()]]
    missing = [row + 1 for row in rows if (number, row) not in origin]
    if missing:
        raise ResultError(f"{group.name} has no drawing number {missing[0]}: of a motion in time"
                          " some 200 states are drawn")
    return [origin.index((number, row)) for row in rows]


def read_grids(pyvista, path, steps):
    """The model in the given steps (from 0): points not yet moved, fields."""
    reader = pyvista.HDFReader(path)
    grids = []
    for step in steps:
        reader.reader.SetStep(step)
        grid = reader.read()
        grids.append((grid[0] if isinstance(grid, pyvista.MultiBlock) else grid).copy())
    return grids


def moved(grid, scale):
    """A grid at its displaced points."""
    copy = grid.copy()
    copy.points = grid.points + scale * grid["displacement"]
    return copy.extract_surface(algorithm="dataset_surface").clean()


def add_edges(plotter, surface, colour, width):
    """Lines along the sharp edges of a surface, or along beams that are lines."""
    edges = surface.extract_feature_edges(feature_angle=40, boundary_edges=True)
    plotter.add_mesh(edges if edges.n_cells else surface, color=colour, line_width=width,
                     lighting=False)


def add_shape(plotter, shape, **options):
    """A coloured surface with its edges in front, or beams as lines."""
    actor = plotter.add_mesh(shape, smooth_shading=True, split_sharp_edges=True, line_width=4,
                             ambient=0.45, diffuse=0.6, **options)
    actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2)
    if shape.n_lines == 0:
        add_edges(plotter, shape, INK, 1.2)
    if shape.n_verts:  # nodes of joints
        dots = shape.verts.reshape(-1, 2)[:, 1]
        plotter.add_mesh(shape.points[dots], color=INK, style="points", point_size=14,
                         render_points_as_spheres=True, lighting=False)


def new_plotter(pyvista, title):
    """White, 1200 by 800 points, without a window."""
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
    plotter.set_background("white")
    plotter.enable_anti_aliasing("msaa", multi_samples=8)
    plotter.enable_parallel_projection()
    if title:
        plotter.add_text(title, position=(30, SIZE[1] - 50), font_size=13, color=INK)
    return plotter


class View:
    """What is seen from azimuth and elevation in degrees, z up: all points above the colour bar."""

    def __init__(self, text, points):
        azimuth, elevation = (np.radians(float(word)) for word in text.split(","))
        away = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth),
                         np.sin(elevation)])
        right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
        self.axes = np.array([right, np.cross(away, right), away])
        flat = points @ self.axes.T
        low, high = flat.min(axis=0), flat.max(axis=0)
        width, height = (high - low)[:2]
        self.tall = max(height / 0.68, width / 0.84 * SIZE[1] / SIZE[0])  # of the picture
        self.target = (0.5 * (low + high) - [0, 0.045 * self.tall, 0]) @ self.axes
        self.eye = self.target + 2 * np.linalg.norm(high - low) * away

    def below(self, point):
        """A place for a text below a point."""
        return point - 0.045 * self.tall * self.axes[1]

    def apply(self, plotter):
        """Put the camera there."""
        plotter.camera.position, plotter.camera.focal_point = self.eye, self.target
        plotter.camera.up = (0, 0, 1)
        plotter.camera.parallel_scale = 0.5 * self.tall
        plotter.reset_camera_clipping_range()


def bar(unit, field):
    """Options of the colour bar."""
    return {"title": FIELDS[field] + (f" ({unit})" if unit else ""), "vertical": False,
            "position_x": 0.25, "position_y": 0.03, "width": 0.5, "height": 0.11,
            "title_font_size": 20, "label_font_size": 17, "n_labels": 5, "fmt": "%.3g",
            "color": INK, "font_family": "arial"}


def limits(grids, field):
    """Range of the colours: signed fields evenly about zero."""
    values = [g[field] if g[field].ndim == 1 else np.linalg.norm(g[field], axis=1) for g in grids]
    top = float(max(np.abs(v).max() for v in values)) or 1.0
    return [-top, top] if field == "axial_stress" else [0, top]


def draw(results, group, rows, output, *, field, largest, apart, view, unit, labels,
         title):
    """Write a picture of some states or modes, each shifted by `apart` from the one before.

    `largest` is the displacement to which modes are scaled. If nothing is shifted the undeformed
    model is shown by thin grey lines.
    """
    pyvista = import_pyvista()
    grids = read_grids(pyvista, results.path, drawn_steps(results, group, rows))
    field = field or ("axial_stress" if "axial_stress" in grids[0].point_data else "displacement")
    if field not in grids[0].point_data:
        raise ResultError(f"no section of {results.path} has an outline: there is no {field}")
    rest = grids[0].copy()
    rest.points = results.file["VTKHDF/Points"][:rest.n_points]
    top = max(limits([grid], "displacement")[1] for grid in grids)
    shapes = [moved(grid, largest / top if largest else 1).translate(k * np.asarray(apart, float))
              for k, grid in enumerate(grids)]
    if not any(apart):
        shapes.append(moved(rest, 0))
    view = View(view, np.concatenate([shape.points for shape in shapes]))
    plotter = new_plotter(pyvista, title)
    for k, shape in enumerate(shapes[:len(grids)]):
        add_shape(plotter, shape, scalar_bar_args=bar(unit, field), show_scalar_bar=k == 0,
                  scalars=field, clim=limits(grids, field),
                  cmap="seismic" if field == "axial_stress" else "viridis")
        if labels:
            far = np.linalg.norm(shape["displacement"], axis=1).argmax()
            plotter.add_point_labels([view.below(shape.points[far])], [labels[k]], shape=None,
                                     font_size=20, text_color=INK, show_points=False,
                                     always_visible=True, bold=False)
    for shape in shapes[len(grids):]:
        add_edges(plotter, shape, PALE, 1.5)
    for actor in plotter.scalar_bars.values():
        actor.SetTextPositionToPrecedeScalarBar()
        actor.SetTextPad(4)
    view.apply(plotter)
    plotter.screenshot(output)
    plotter.close()
