"""Drawings on axes of matplotlib: path curves, deformed frames, mode shapes."""
import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap, to_rgb

INK, GREY, PALE = "#1a1a1a", "#8c8c8c", "#c8c8c8"
COLOURS = ["#1f5a96", "#c8501e", "#3c8c50", "#7a4c9e", "#b0891c"]
SHADES = LinearSegmentedColormap.from_list("frames", ["#a9c6e3", "#1f5a96", "#0c2340"])
PLANES = {"XY": (0, 1), "XZ": (0, 2), "YZ": (1, 2)}

STYLE = {
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "legend.fontsize": 8,
    "xtick.labelsize": 8, "ytick.labelsize": 8, "axes.linewidth": 0.6,
    "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": INK,
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS), "lines.linewidth": 1.4,
    "lines.markersize": 3.5, "legend.frameon": False, "axes.grid": False,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4, "savefig.dpi": 160, "figure.constrained_layout.use": True,
    "mathtext.fontset": "dejavusans", "axes.axisbelow": True,
}


def new_figure(width=4.6, height=3.2, columns=1, rows=1, **options):
    """Figure and axes without a window, in the style above."""
    matplotlib.use("Agg")
    from matplotlib import pyplot
    pyplot.rcParams.update(STYLE)
    return pyplot.subplots(rows, columns, figsize=(width, height), **options)


def save(figure, path):
    """Write and forget a figure; the file holds neither date nor version."""
    from matplotlib import pyplot
    metadata = {"Software": None} if str(path).endswith(".png") else {}
    figure.savefig(path, metadata=metadata)
    pyplot.close(figure)


class View:
    """Projection on a plane `XZ`, or from a direction `azimuth,elevation` in degrees."""

    def __init__(self, text):
        self.plane = text.upper() if text.upper() in PLANES else None
        if self.plane:
            self.matrix = np.eye(3)[list(PLANES[self.plane])]
            away = np.cross(*self.matrix)
        else:
            azimuth, elevation = (np.radians(float(word)) for word in text.split(","))
            away = np.array([np.cos(elevation) * np.cos(azimuth),
                             np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
            right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
            self.matrix = np.array([right, np.cross(away, right)])
        self.away = away

    def flat(self, points):
        """Points (..., 3) in the picture (..., 2)."""
        return points @ self.matrix.T

    def depth(self, points):
        """Nearness to the eye."""
        return points @ self.away


def draw_lines(axes, shapes, state, view, **options):
    """The axes of all elements."""
    axes.add_collection(LineCollection(list(view.flat(shapes.curves(state))), **options))


def draw_swept(axes, shapes, state, view, outline, colour, line=INK, alpha=1.0):
    """The walls of an open section, far ones first; shaded by their inclination."""
    points = shapes.swept(state, outline)
    corners = np.stack([points[:, :-1, :-1], points[:, 1:, :-1],
                        points[:, 1:, 1:], points[:, :-1, 1:]], -2).reshape(-1, 4, 3)
    order = np.argsort(view.depth(corners).mean(1))
    corners = corners[order]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
    facing = abs(normal @ view.away) / np.maximum(np.linalg.norm(normal, axis=1), 1e-30)
    tone = (0.62 + 0.38 * facing)[:, None]
    colours = np.clip(1 - tone * (1 - np.array(to_rgb(colour))), 0, 1)
    axes.add_collection(PolyCollection(view.flat(corners), facecolors=colours, alpha=alpha,
                                       edgecolors=colours, linewidths=0.3))
    for k in range(points.shape[2]):
        axes.add_collection(LineCollection(list(view.flat(points[:, :, k])), colors=line,
                                           linewidths=0.4, alpha=0.8 * alpha))
    ends = [points[0, 0], points[-1, -1]]
    axes.add_collection(LineCollection([view.flat(end) for end in ends], colors=line,
                                       linewidths=0.8, alpha=alpha))


def finish_view(axes, view, unit, bar=None):
    """Equal scales; labelled axes of a plane, else axis directions and a scale bar."""
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.margins(0.05)
    if view.plane:
        axes.set_xlabel(with_unit(view.plane[0], unit))
        axes.set_ylabel(with_unit(view.plane[1], unit))
        return
    axes.axis("off")
    low, high = np.array([axes.get_xlim(), axes.get_ylim()]).T
    size = 0.07 * (high - low).max()
    low = low - [0, 2.2 * size]
    draw_directions(axes, view, low + [1.3 * size, 0.8 * size], size)
    if bar:
        start = low + [3.2 * size, 0.4 * size]
        axes.plot([start[0], start[0] + bar], [start[1]] * 2, color=INK, lw=1.2)
        axes.text(start[0] + bar / 2, start[1] + 0.2 * size, f"{bar:g} {unit}".strip(),
                  ha="center", va="bottom", fontsize=7)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))


def draw_directions(axes, view, corner, size):
    """The three global directions, as arrows."""
    for name, vector in zip("XYZ", np.eye(3)):
        arrow = size * view.flat(vector)
        axes.annotate("", corner + arrow, corner, arrowprops={
            "arrowstyle": "-|>", "lw": 0.7, "color": GREY, "mutation_scale": 6,
            "shrinkA": 0, "shrinkB": 0})
        axes.text(*(corner + 1.3 * arrow), name, color=GREY, fontsize=7, ha="center", va="center")


def with_unit(name, unit):
    """`name (unit)`, or the name alone."""
    return f"{name} ({unit})" if unit else name


def round_length(length):
    """The nearest of 1, 2, 5 times a power of ten below a length."""
    power = 10.0 ** np.floor(np.log10(length))
    return max(k * power for k in (1, 2, 5) if k * power <= length)
