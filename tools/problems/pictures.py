"""The pictures of docs/validation.md; only they need matplotlib."""
import numpy as np

from spar_tools import figures
from spar_tools.shapes import Shapes

from .exact import elliptic

# Midlines of the sections (y, z), from the centroid.
CHANNEL = [(7.0442, 14.2), (-2.4558, 14.2), (-2.4558, -14.2), (7.0442, -14.2)]
COLUMN = [(428.57, 300), (-171.43, 300), (-171.43, -300), (428.57, -300)]


def elastica(path, results, parts, tip, exact):
    """Shapes on the left, tip against load on the right; dots are the closed form."""
    figure, (left, right) = figures.new_figure(6.8, 2.9, 2, width_ratios=[1, 1.1])
    shapes = Shapes(results)
    view = figures.View("XZ")
    chosen = [(0, 0), (0, 1), (0, 3), (0, 5), (1, 2), (2, 3), (2, 8)]
    for k, (part, step) in enumerate(chosen):
        state = results.step_state(parts[part], step)
        colour = figures.PALE if step == 0 else figures.SHADES(k / (len(chosen) - 1))
        figures.draw_lines(left, shapes, state, view, colors=[colour], linewidths=1.4)
        load = parts[part]["load_factor"][step - 1] if step else 0
        place = view.flat(shapes.curves(state)[-1, -1])
        left.annotate(f"{load:.2g}", place, (3, 2), textcoords="offset points", fontsize=7)
    figures.finish_view(left, view, "")
    left.set(xlabel="x/L", ylabel="z/L", ylim=(-0.05, 0.95), xlim=(-0.04, 1.12))
    for values, reference, name, colour in zip(tip, exact[:, 1:].T, ("w/L", "u/L", "θ"),
                                               figures.COLOURS):
        right.plot([0, *exact[:, 0]], [0, *values], color=colour)
        right.plot(exact[:, 0], reference, "o", color=colour, mfc="white", mew=0.9)
        right.text(10.2, values[-1], name, color=colour, fontsize=8, va="center")
    right.plot([], [], color=figures.GREY, label="spar")
    right.plot([], [], "o", color=figures.GREY, mfc="white", mew=0.9, label="closed form")
    right.set(xlabel="PL²/EI", xlim=(0, 11.2), ylim=(0, 1.6))
    right.legend(loc="upper left", ncols=2)
    figures.save(figure, path)


def roll_up(path, results, meshes, computed):
    """Shapes of the ten steps, and the error against the law."""
    figure, (left, right) = figures.new_figure(6.4, 2.8, 2)
    shapes, view = Shapes(results), figures.View("XZ")
    for step in range(11):
        colour = figures.PALE if step == 0 else figures.SHADES(step / 10)
        figures.draw_lines(left, shapes, results.step_state(results.analysis(), step), view,
                           colors=[colour], linewidths=1.4)
    figures.finish_view(left, view, "")
    left.set(xlabel="x/L", ylabel="z/L")
    n = np.array([3.5, 36])
    right.loglog(n, (np.pi / n)**4 / 1920, color=figures.GREY, lw=1, label="a⁴/1920, a = π/n")
    right.loglog(meshes, computed, "o", color=figures.COLOURS[0], label="spar")
    elements_axis(right, meshes)
    right.set_ylabel("error of the half circle")
    right.legend()
    figures.save(figure, path)


def elements_axis(axes, meshes):
    """Numbers of elements on a logarithmic axis."""
    axes.set_xscale("log")
    axes.set_xticks(meshes, labels=[str(n) for n in meshes])
    axes.minorticks_off()
    axes.set_xlabel("elements")


def channel(path, paths, curve):
    """The picture of the README: frames with their section, load over deflection."""
    figure, (left, right) = figures.new_figure(7.4, 2.9, 2, width_ratios=[1.35, 1])
    results, values = paths["CONSISTENT", 10]
    group = results.analysis()
    shapes = Shapes(results, points=7)
    view = figures.View("-115,16")
    frames = {0: figures.PALE, 20: "#b5cfe6", 50: "#6f9fcb", 100: "#1f5a96"}
    for step, colour in frames.items():
        state = results.step_state(group, step)
        figures.draw_swept(left, shapes, state, view, CHANNEL, colour)
        if step:
            tip = view.flat(shapes.curves(state)[-1, -1])
            left.annotate(f"{values[0][step]:.1f} kN", tip, (9, -3 if step < 100 else 5),
                          textcoords="offset points", fontsize=8)
    figures.finish_view(left, view, "cm", 200)
    draw_curves(right, paths, curve, 1, "-w_D")
    for step, colour in list(frames.items())[1:]:
        right.plot(values[1][step], values[0][step], "o", ms=7, zorder=5, color=colour,
                   mec=figures.INK, mew=0.7)
    right.set(xlabel="deflection of D, −w (cm)", ylabel="force at D (kN)", xlim=(0, 310),
              ylim=(0, 27))
    right.legend(loc="lower right")
    figures.save(figure, path)


def fig_12(path, paths, curve):
    """F over -w(D) for loads at D and E, and F over v(D)."""
    figure, (left, right) = figures.new_figure(7.0, 3.2, 2, width_ratios=[1.2, 1])
    draw_curves(left, paths, curve, 1, "-w_D")
    _, at_e = paths["E"]
    left.plot(at_e[1], at_e[0], color=figures.COLOURS[2], label="spar, load at E")
    left.set(xlabel="−w of D (cm)", ylabel="F (kN)", xlim=(0, 310), ylim=(0, 27))
    left.legend(loc="lower right")
    draw_curves(right, paths, curve, 2, "v_D")
    right.set(xlabel="v of D (cm)", ylabel="F (kN)", xlim=(0, None), ylim=(0, 27))
    figures.save(figure, path)


def draw_curves(axes, paths, curve, column, name):
    """CONSISTENT and JONKER over the shell."""
    sign = -1 if name.startswith("-") else 1
    inside = -curve["w_D"] <= 302
    axes.plot([0, *(sign * curve[name.lstrip("-")][inside])], [0, *curve["F"][inside]], "o",
              color=figures.GREY, mfc="white", mew=0.8, ms=3.5,
              label="shell, 120 eight-node elements")
    for (second, n), colour, style in ((("CONSISTENT", 10), figures.COLOURS[0], "-"),
                                       (("JONKER", 40), figures.COLOURS[1], "--")):
        _, values = paths[second, n]
        label = "spar, 10 beam elements" if n == 10 else "as printed in the paper, 40"
        axes.plot(values[column], values[0], style, color=colour, label=label)


def lee(path, results, group, p, v, u, limits):
    """Load over both displacements; some deformed frames."""
    figure, (left, right) = figures.new_figure(7.0, 3.3, 2, width_ratios=[1.15, 1])
    for values, name, colour in ((v, "v", figures.COLOURS[0]), (u, "u", figures.COLOURS[1])):
        left.plot(values, p, "-o", color=colour, ms=2.5, lw=1.1)
        left.annotate(name, (values[-1], p[-1]), (4, -9), textcoords="offset points", color=colour)
    for limit in limits:
        k = int(np.argmin(abs(p - limit)))
        left.axhline(limit, color=figures.PALE, lw=0.7, zorder=0)
        left.plot(v[k], limit, "o", mfc="white", mec=figures.INK, ms=6, zorder=5)
        left.plot(u[k], limit, "o", mfc="white", mec=figures.INK, ms=6, zorder=5)
        name = f"limit point {limit:.4f}".replace("-", "\N{MINUS SIGN}")
        left.text(-4, limit + 0.06, name, fontsize=7)
    left.set(xlabel="displacement of the load (cm)", ylabel="P (kN)", xlim=(-5, None))
    shapes, view = Shapes(results), figures.View("XZ")
    chosen = [0, 12, 21, 32, 42, len(p) - 1]
    for k, step in enumerate(chosen):
        colour = figures.PALE if step == 0 else figures.SHADES(k / (len(chosen) - 1))
        state = results.step_state(group, step)
        figures.draw_lines(right, shapes, state, view, colors=[colour], linewidths=1.4)
        place = (results.position + state[0])[results.node(3)][[0, 2]]
        right.plot(*place, "o", color=colour, ms=4)
        right.annotate(f"{p[step]:.2f}".replace("-", "\N{MINUS SIGN}"), place,
                       (5, 4 if p[step] >= 0 else -9), textcoords="offset points", fontsize=7)
    figures.finish_view(right, view, "cm")
    figures.save(figure, path)


def column(path, results, group, p, angle):
    """Load over the rotation of the tip; shapes."""
    figure, (left, right) = figures.new_figure(6.2, 2.9, 2, width_ratios=[1.3, 1])
    theta = np.linspace(1e-3, np.radians(125), 80)
    left.plot(np.degrees(theta), [(2 * elliptic(np.sin(t / 2))[0] / np.pi)**2 for t in theta],
              color=figures.GREY, lw=1, label="closed form")
    left.plot(np.degrees(angle), p, "o", color=figures.COLOURS[0], label="spar, 10 elements")
    left.set(xlabel="rotation of the tip (degrees)", ylabel="P/P1", ylim=(0, 2.05), xlim=(-2, 126))
    left.legend(loc="lower right")
    shapes, view = Shapes(results), figures.View("XZ")
    chosen = [0, *(int(np.argmin(abs(np.degrees(angle) - t))) + 1 for t in (20, 45, 70, 95, 120))]
    for k, step in enumerate(chosen):
        colour = figures.PALE if step == 0 else figures.SHADES(k / (len(chosen) - 1))
        figures.draw_lines(right, shapes, results.step_state(group, step), view, colors=[colour],
                           linewidths=1.4)
    figures.finish_view(right, view, "")
    right.set(xlabel="x/L", ylabel="z/L")
    figures.save(figure, path)


def table_2(path, results, meshes, values, exact):
    """Errors of both element versions; the first buckling mode."""
    figure, (left, right) = figures.new_figure(7.0, 3.0, 2, width_ratios=[1, 1.05])
    for (second, shear), loads in values.items():
        colour = figures.COLOURS[second == "JONKER"]
        error = [abs(x / exact[shear] - 1) for x in loads]
        marker, line = ("o", "-") if shear == "ON" else ("s", "--")
        theory = "with shear" if shear == "ON" else "Vlasov"
        left.loglog(meshes, error, line, marker=marker, color=colour,
                    mfc="white" if shear == "OFF" else colour, label=f"{second}, {theory}")
    elements_axis(left, meshes)
    left.set(ylabel="error of the buckling load", ylim=(5e-8, 0.3))
    left.legend(loc="lower left")
    state = results.mode_state(results.analysis(), 1, 500)
    view, shapes = figures.View("-58,22"), Shapes(results)
    figures.draw_lines(right, shapes, results.step_state(None, 0), view, colors=figures.GREY,
                       linewidths=0.8)
    figures.draw_swept(right, shapes, state, view, COLUMN, "#6f9fcb")
    figures.finish_view(right, view, "mm", 2000)
    right.set_title("first mode, Vlasov")
    figures.save(figure, path)


def monosymmetric(path, values, exact, meshes):
    """Errors of both element versions for both signs."""
    figure, axes = figures.new_figure(3.8, 2.9)
    for (second, sign), loads in values.items():
        colour = figures.COLOURS[second == "JONKER"]
        flange = "large" if sign > 0 else "small"
        axes.loglog(meshes, [abs(x / exact[sign] - 1) for x in loads], "-" if sign > 0 else "--",
                    marker="o" if sign > 0 else "s", mfc=colour if sign > 0 else "white",
                    color=colour, label=f"{second}, {flange} flange")
    elements_axis(axes, meshes)
    axes.set_ylabel("error of the buckling moment")
    axes.set_ylim(1e-8, 9)
    axes.legend(loc="upper right", ncols=2, fontsize=7, columnspacing=1)
    figures.save(figure, path)


def table_3(path, meshes, errors):
    """With shear and rigid in shear; modes 1 and 3."""
    figure, panels = figures.new_figure(6.8, 3.0, 2, sharey=True)
    for axes, shear, title in zip(panels, ("ON", "OFF"), ("with shear", "rigid in shear (Vlasov)")):
        for name, colour in (("JONKER", figures.COLOURS[1]), ("CONSISTENT", figures.COLOURS[0])):
            for mode, line in ((1, "-o"), (3, "--s")):
                shown = meshes[mode // 3:]
                values = [e[mode - 1] for e in errors[name, shear]][-len(shown):]
                label = f"{name}, paper's mass" if name == "JONKER" else name
                axes.loglog(shown, values, line, color=colour, label=f"{label}, mode {mode}",
                            mfc=colour if mode == 1 else "white")
        elements_axis(axes, meshes)
        axes.set_title(title)
    panels[0].set_ylabel("error of the frequency")
    panels[0].legend(loc="lower left", fontsize=7)
    figures.save(figure, path)


def leaf_guide(path, results, beam, warped, exact, law):
    """Support stiffness over the stroke, on a logarithmic scale; shapes."""
    figure, (left, right) = figures.new_figure(7.0, 3.0, 2, width_ratios=[1.35, 1])
    at_rest, drop = law
    stroke = np.linspace(0, 20, 100)
    left.semilogy(stroke, 1 / (at_rest * (1 + drop * stroke**2)), color=figures.GREY, lw=1,
                  label="along, second-order beam")
    left.semilogy(exact[:, 0], 1 / beam[:, 0, 0], "o", color=figures.COLOURS[0],
                  label="along, spar")
    left.semilogy(exact[:, 0], 1 / exact[:, 3], color=figures.PALE, lw=1,
                  label="across, integrated")
    left.semilogy(exact[:, 0], 1 / beam[:, 2, 2], "s", color=figures.COLOURS[1],
                  label="across, spar")
    left.semilogy(exact[:, 0], 1 / warped[:, 2, 2], "s", color=figures.COLOURS[1], mfc="white",
                  label="across, spar, warping held")
    left.set(xlabel="stroke (mm)", ylabel="support stiffness (N/mm)", xlim=(0, 20.6), ylim=(6, 2e5))
    left.legend(loc="lower left", fontsize=7)
    draw_planar(right, results, [0, 4, 8])
    figures.save(figure, path)


def cross_hinge(path, results, compliance, exact):
    """Support stiffness over the angle; shapes."""
    figure, (left, right) = figures.new_figure(7.0, 3.0, 2, width_ratios=[1.35, 1])
    for k, (name, colour) in enumerate(zip("xyz", figures.COLOURS)):
        left.semilogy(exact[:, 0], 1 / exact[:, 3 + k], color=colour, lw=1)
        left.semilogy(exact[:, 0], 1 / compliance[:, k, k], "os^"[k], color=colour,
                      mfc="white" if k == 1 else colour, label=f"{name}, spar")
    left.plot([], [], color=figures.GREY, lw=1, label="integrated")
    left.set(xlabel="angle (degrees)", ylabel="support stiffness (N/mm)", xlim=(0, 20.6))
    left.legend(loc="upper right")
    draw_planar(right, results, [0, 4, 8])
    figures.save(figure, path)


def draw_planar(axes, results, steps):
    """States of a mechanism in its plane XY."""
    shapes, view = Shapes(results), figures.View("XY")
    group = results.analysis()
    for k, step in enumerate(steps):
        colour = figures.PALE if step == 0 else figures.SHADES(k / (len(steps) - 1))
        state = results.step_state(group, step)
        figures.draw_lines(axes, shapes, state, view, colors=[colour], linewidths=1.4)
    figures.finish_view(axes, view, "mm")
