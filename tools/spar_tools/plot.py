"""spar-plot: path curves, time histories, deformed frames, mode shapes, surfaces of spar's results."""
import argparse
import sys
from pathlib import Path

import numpy as np

from . import figures, surface
from .results import IN_TIME, ResultError, Results
from .shapes import Shapes

PATHS, MODES = ("static", "stationary"), ("buckling", "eigen")

def parser():
    """The command line."""
    top = argparse.ArgumentParser(prog="spar-plot", description=__doc__)
    commands = top.add_subparsers(dest="command", required=True)
    curve = commands.add_parser("curve", help="one series of an analysis against another")
    curve.add_argument("files", nargs="+", metavar="OUT.h5")
    series = "load_factor, nodes/ID/X, nodes/ID/angle, markers/NAME/Z, convergence/iterations; "
    curve.add_argument("--x", required=True, metavar="PATH", help=series + "--x=-PATH reverses it")
    curve.add_argument("--y", action="append", metavar="PATH", help="the same; may be repeated")
    curve.add_argument("--x-label", metavar="TEXT")
    curve.add_argument("--y-label", metavar="TEXT")
    curve.add_argument("--label", action="append", metavar="TEXT", help="of each curve, in order")
    curve.add_argument("--no-origin", action="store_true", help="do not add the point (0, 0)")
    history = commands.add_parser("history", help="quantities of a motion against time")
    history.add_argument("files", nargs="+", metavar="OUT.h5")
    history.add_argument("--node", action="append", default=[], metavar="ID",
                         help="7, or 7.2 for an inner node; may be repeated")
    history.add_argument("--component", action="append", metavar="X",
                         help="X, Y, Z, angle or warping of the nodes (default: X, Y and Z)")
    history.add_argument("--quantity", default="displacement", metavar="NAME",
                         help="displacement, velocity, acceleration, angular_velocity, ...")
    history.add_argument("--y", action="append", default=[], metavar="PATH",
                         help="another series: energy/kinetic, markers/NAME/Z, joints/ID/strain/1")
    history.add_argument("--time-unit", default="", metavar="TEXT", help="the deck's unit of time")
    history.add_argument("--y-label", metavar="TEXT")
    frames = commands.add_parser("frames", help="deformed shapes of steps of a path or a motion")
    frames.add_argument("--steps", nargs="+", type=int, metavar="N",
                        help="recorded steps, 0 the initial one (default: six)")
    modes = commands.add_parser("modes", help="mode shapes of a buckling or eigen analysis")
    modes.add_argument("--modes", nargs="+", type=int, metavar="N", help="default: the first four")
    modes.add_argument("--scale", type=float, help="largest displacement in the picture")
    for command in (frames, modes):
        command.add_argument("files", nargs=1, metavar="OUT.h5")
        command.add_argument("--view", default=None, metavar="VIEW",
                             help="XZ, XY, YZ or AZIMUTH,ELEVATION in degrees")
        command.add_argument("--outline", metavar="Y,Z:Y,Z...",
                             help="midline of an open section, drawn along the beams")
    for command in (curve, history, frames, modes):
        command.add_argument("--analysis", metavar="NAME", help="number or name (default: last)")
        command.add_argument("--unit", default="", metavar="TEXT", help="the deck's unit of length")
        command.add_argument("-o", "--output", metavar="PICTURE", help=".png, .pdf or .svg")
    add_surface(commands)
    return top


def add_surface(commands):
    """The command of spatial pictures."""
    command = commands.add_parser("surface", help="a spatial picture, coloured by a field"
                                                  " (needs pyvista)")
    command.add_argument("files", nargs=1, metavar="OUT.h5")
    command.add_argument("--analysis", metavar="NAME", help="number or name (default: last)")
    command.add_argument("--steps", nargs="+", type=int, metavar="N",
                         help="recorded steps or numbers of modes (default: last step, mode 1)")
    command.add_argument("--field", choices=surface.FIELDS, default=None,
                         help="default: axial_stress where a section has an outline")
    command.add_argument("--scale", type=float,
                         help="of modes: largest displacement in the picture")
    command.add_argument("--apart", default="0,0,0", metavar="DX,DY,DZ",
                         help="from one shape to the next")
    command.add_argument("--view", default="60,25", metavar="AZIMUTH,ELEVATION", help="in degrees")
    command.add_argument("--unit", default="", metavar="TEXT", help="the deck's unit of the field")
    command.add_argument("--load-unit", default="", metavar="TEXT", help="of a unit load factor")
    command.add_argument("--title", default="", metavar="TEXT")
    command.add_argument("-o", "--output", metavar="PICTURE", help=".png")


def best_plane(points):
    """The plane that shows most of a cloud of points, or a direction if it is spatial."""
    size = np.ptp(points, axis=0)
    flat = int(np.argmin(size))
    return ("YZ", "XZ", "XY")[flat] if size[flat] < 0.02 * size.max() else "-60,25"


def outline_points(text):
    """(y, z) of `Y,Z:Y,Z...`."""
    try:
        return np.array([[float(word) for word in pair.split(",")] for pair in text.split(":")])
    except ValueError:
        raise ResultError(f"'{text}' is not an outline: write y,z:y,z") from None


def plot_curve(options):
    """A figure of path curves."""
    figure, axes = figures.new_figure()
    paths = options.y or ["load_factor"]
    labels = list(options.label or [])
    for name in options.files:
        with Results(name) as results:
            group = results.analysis(options.analysis, ("static", "stationary"))
            x = results.series(group, options.x)
            for path in paths:
                y = results.series(group, path)
                points = [(0, 0)] * (not options.no_origin) + list(zip(x, y))
                label = labels.pop(0) if labels else " ".join(
                    [Path(name).stem] * (len(options.files) > 1) + [path] * (len(paths) > 1))
                axes.plot(*np.array(points).T, marker="o", label=label or None)
    axes.set_xlabel(options.x_label or axis_label(options.x, options.unit))
    axes.set_ylabel(options.y_label or axis_label(paths[0], options.unit)
                    if len(paths) == 1 or options.y_label else "")
    if axes.get_legend_handles_labels()[0]:
        axes.legend()
    return figure


def history_paths(options):
    """The series asked for."""
    paths = []
    for node in options.node:
        for component in options.component or ["X", "Y", "Z"]:
            whole = options.quantity == "displacement" or component in ("angle", "warping")
            paths.append(f"nodes/{node}/{'' if whole else options.quantity + '/'}{component}")
    if not paths + options.y:
        raise ResultError("nothing to draw: give --node or --y")
    return paths + options.y


def plot_history(options):
    """A figure of quantities against time."""
    figure, axes = figures.new_figure(6.0, 3.2)
    paths = history_paths(options)
    for name in options.files:
        with Results(name) as results:
            group = results.analysis(options.analysis, IN_TIME)
            time = results.series(group, "time")
            for path in paths:
                words = [Path(name).stem] * (len(options.files) > 1)
                words += [axis_label(path, "")] * (len(paths) > 1)
                axes.plot(time, results.series(group, path), label=" ".join(words) or None)
    axes.set_xlabel(figures.with_unit("time", options.time_unit))
    axes.set_ylabel(options.y_label or (axis_label(paths[0], options.unit)
                                        if len(paths) == 1 else ""))
    if axes.get_legend_handles_labels()[0]:
        axes.legend()
    return figure


def axis_label(path, unit):
    """`-markers/D/Z` read aloud, with the unit."""
    sign = "\N{MINUS SIGN}" if path.startswith("-") else ""
    words = path.lstrip("-").split("/")
    if words[0] == "nodes" and len(words) == 4:
        return f"{sign}{words[2].replace('_', ' ')} {words[3].upper()} of node {words[1]}"
    if words[0] == "energy":
        return f"{sign}{words[1]} (energy)"
    if words[0] == "joints" and len(words) == 4:
        return f"{sign}{words[2]} {words[3]} of joint {words[1]}"
    if words[-1].upper() in ("X", "Y", "Z"):
        where = f"{words[0][:-1]} {words[1]}"
        return figures.with_unit(f"{sign}displacement {words[-1].upper()} of {where}", unit)
    if words[0] == "nodes" and len(words) == 3:
        return f"{sign}{words[2]} of node {words[1]}"
    return sign + words[-1].replace("_", " ")


def draw_state(axes, shapes, state, view, outline, colour):
    """One state, as lines or with its section."""
    if outline is None:
        figures.draw_lines(axes, shapes, state, view, colors=[colour], linewidths=1.5)
    else:
        figures.draw_swept(axes, shapes, state, view, outline, colour)


def plot_frames(options):
    """A figure of deformed frames."""
    with Results(options.files[0]) as results:
        group = results.analysis(options.analysis, (*PATHS, *IN_TIME))
        last = group["step"][-1]
        even = np.linspace(0, last, min(6, last + 1)).round().astype(int)
        steps = options.steps or sorted(set(even))
        shapes = Shapes(results)
        states = [results.step_state(group, step) for step in steps]
        level = results.levels(group, steps)
        legend = "time" if results.in_time(group) else "load factor"
    cloud = np.concatenate([shapes.curves(state).reshape(-1, 3) for state in states])
    view = figures.View(options.view or best_plane(cloud))
    outline = options.outline and outline_points(options.outline)
    figure, axes = figures.new_figure(5.6, 3.8)
    for k, (state, step) in enumerate(zip(states, steps)):
        colour = figures.PALE if step == 0 else figures.SHADES(k / max(1, len(steps) - 1))
        draw_state(axes, shapes, state, view, outline, colour)
        axes.plot([], [], color=colour, lw=2, label=f"{level[k]:.4g}")
    figures.finish_view(axes, view, options.unit, figures.round_length(np.ptp(cloud, 0).max() / 4))
    axes.legend(title=legend, loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


def plot_modes(options):
    """A figure of mode shapes, one frame each."""
    with Results(options.files[0]) as results:
        group = results.analysis(options.analysis, MODES)
        kind = results.kind(group)
        values = group["load_factor" if kind == "buckling" else "frequency"][()]
        modes = options.modes or list(range(1, min(4, len(values)) + 1))
        shapes = Shapes(results)
        rest = results.step_state(group, 0)
        size = np.ptp(results.position, 0).max()
        states = [results.mode_state(group, m, options.scale or size / 8) for m in modes]
    cloud = np.concatenate([shapes.curves(s).reshape(-1, 3) for s in [rest, *states]])
    view = figures.View(options.view or best_plane(cloud))
    outline = options.outline and outline_points(options.outline)
    width, height = np.ptp(view.flat(cloud), axis=0)
    columns = min(4 if height > 0.6 * width else 2, len(modes))
    rows = -(-len(modes) // columns)
    panel = 6.8 / max(2, columns)
    figure, grid = figures.new_figure(
        panel * columns, (panel * min(1.2, height / width) + 0.5) * rows, columns, rows,
        squeeze=False, sharex=bool(view.plane), sharey=bool(view.plane))
    figure.suptitle("modes and their " + ("load factors" if kind == "buckling" else "frequencies"),
                    fontsize=9)
    for axes, mode, state in zip(grid.flat, modes, states):
        figures.draw_lines(axes, shapes, rest, view, colors=figures.PALE, linewidths=1)
        draw_state(axes, shapes, state, view, outline, figures.COLOURS[0])
        axes.set_title(f"{mode}: {values[mode - 1]:.5g}")
        figures.finish_view(axes, view, options.unit)
        axes.label_outer()
    for axes in list(grid.flat)[len(modes):]:
        axes.axis("off")
    return figure


def plot_surface(options, output):
    """Write a spatial picture of steps or modes."""
    with Results(options.files[0]) as results:
        group = results.analysis(options.analysis, (*MODES, *PATHS, *IN_TIME))
        steps = options.steps or [group["step"][-1] if "step" in group else 1]
        rows = results.rows(group, steps) if "step" in group else [mode - 1 for mode in steps]
        labels, largest = None, None
        if "step" not in group:
            largest = options.scale or np.ptp(results.position, 0).max() / 8
        elif len(steps) > 1:
            labels = [f"{level:.3g} {options.load_unit}".strip()
                      for level in results.levels(group, steps)]
        surface.draw(results, group, rows, output, field=options.field,
                     largest=largest, apart=[float(word) for word in options.apart.split(",")],
                     view=options.view, unit=options.unit, labels=labels, title=options.title)


def main(arguments=None):
    """Draw what is asked for; exit status 2 with one line if it is not in the file."""
    options = parser().parse_args(arguments)
    draw = {"curve": plot_curve, "history": plot_history, "frames": plot_frames,
            "modes": plot_modes}
    output = options.output or f"{Path(options.files[0]).stem}_{options.command}.png"
    try:
        for name in options.files:
            if not Path(name).is_file():
                raise ResultError(f"there is no file {name}")
        if options.command == "surface":
            plot_surface(options, output)
        else:
            figures.save(draw[options.command](options), output)
    except (ResultError, OSError, KeyError) as error:
        print(f"spar-plot: {error}", file=sys.stderr)
        return 2
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
