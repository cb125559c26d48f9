"""Drawings of elements with their quantities, as SVG."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlwave.choices import chosen

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STEEL, EDGE, INK = "0.86", "0.35", "#14405c"
GAP = 3.0
"""Between an arrow and its letter, points."""


def drawing_svg(element: str) -> str:
    """Return the drawing of an element, SVG without a head.

    Parameters
    ----------
    element : str
        Name of the class.

    Examples
    --------
    >>> from ehlwave.elements.drawing import drawing_svg
    >>> drawing_svg("SpurGearPair").startswith("<svg")
    True
    """
    from matplotlib import rc_context
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    chosen(element, "element", DRAWINGS, "drawing_svg")
    file = io.StringIO()
    with rc_context({"svg.hashsalt": "ehlwave", "svg.fonttype": "none", "font.size": 9}):
        figure = Figure(figsize=(6.4, 3.4), layout="constrained")
        axes = figure.subplots()
        DRAWINGS[element](axes)
        axes.set_aspect("equal")
        axes.set_axis_off()
        canvas = FigureCanvasSVG(figure)
        canvas.print_figure(file, format="svg", bbox_inches="tight", metadata={"Date": None})
    text = file.getvalue()
    text = text[text.index("<svg") :]
    size = r'style="width:100%;max-width:\1pt;height:auto"'
    return re.sub(r'width="([\d.]+)pt" height="[\d.]+pt"', size, text, count=1)


def _disc(axes: Axes, x: float, y: float, r: float, **style: Any) -> None:  # noqa: ANN401
    from matplotlib.patches import Circle

    look = {"facecolor": STEEL, "edgecolor": EDGE, "lw": 1.0} | style
    axes.add_patch(Circle((x, y), r, **look))


def _arrow(
    axes: Axes,
    start: Any,  # noqa: ANN401
    end: Any,  # noqa: ANN401
    text: str,
    *,
    ends: str = "<->",
    at: float = 0.5,
    side: int = 1,
) -> None:
    """Draw a dimension or an arrow; its letter stands `GAP` points beside it, at 1 behind it."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": ends, "color": INK, "lw": 1.0})
    start, end = np.asarray(start, float), np.asarray(end, float)
    along = (end - start) / math.dist(end, start)
    # Above an arrow, at the right of a vertical one; `side` -1: below, at the left.
    aside = along if at == 1 else side * np.array([-along[1], along[0]])
    if at != 1 and aside @ (0.5, 1.0) * side < 0:
        aside = -aside
    across, up = np.round(aside, 1)
    axes.annotate(
        text,
        start + at * (end - start),
        aside * GAP,
        textcoords="offset points",
        color=INK,
        ha="left" if across > 0.3 else "right" if across < -0.3 else "center",
        va="bottom" if up > 0.3 else "top" if up < -0.3 else "center",
    )


def _bearing(axes: Axes, *, is_roller: bool = False, angle: float = 0.0) -> None:
    """Draw the side view with the load zone, and a section through race and element."""
    count, pitch, size = (9, 3.0, 0.62)
    for radius, colour in ((4.3, STEEL), (pitch + size, "white"), (pitch - size, STEEL)):
        _disc(axes, 0, 0, radius, facecolor=colour)
    _disc(axes, 0, 0, 1.6, facecolor="white")
    for k in range(count):
        turn = math.radians(-90 + 360 * k / count)
        _disc(axes, pitch * math.cos(turn), pitch * math.sin(turn), size, facecolor="white")
        load = max(math.cos(turn + math.pi / 2), 0) ** 1.5
        if load > 0.1:
            start = np.array([math.cos(turn), math.sin(turn)]) * 4.4
            _arrow(axes, start * (1 + 0.28 * load), start, "", ends="->")
    _disc(axes, 0, 0, pitch, facecolor="none", ls="--", lw=0.7)
    _arrow(axes, (-0.6, 1.2), (-0.6, -0.6), "$F_r$", ends="->")
    for end in (-pitch, pitch):
        axes.plot([end, end], [0, 5.2], color=INK, lw=0.5)
    _arrow(axes, (-pitch, 4.9), (pitch, 4.9), "$d_m$")
    axes.text(0.35, -5.5, "Q at angle 0", color=INK)
    for turn in (0.0, 0.7):
        axes.plot([0, 3.6 * math.sin(turn)], [0, -3.6 * math.cos(turn)], ":", color=INK, lw=0.9)
    axes.text(0.66, -1.86, "angle", color=INK, ha="center", va="center", fontsize=7.5)
    x = 8.6
    if is_roller:
        _section_of_roller(axes, x, angle)
    else:
        _section_of_ball(axes, x, angle)
    axes.set(xlim=(-4.8, 13), ylim=(-6.3, 5.6))


def _section_of_ball(axes: Axes, x: float, angle: float) -> None:
    from matplotlib.patches import Arc, Rectangle

    for low in (1.25, -3.1):
        axes.add_patch(Rectangle((x - 2.3, low), 4.6, 1.85, facecolor=STEEL, edgecolor=EDGE))
    _disc(axes, x, 0, 1.62, facecolor="white", lw=0)
    _disc(axes, x, 0, 1.5, facecolor="0.95")
    for start in (20, 200):
        axes.add_patch(Arc((x, 0), 3.24, 3.24, theta1=start, theta2=start + 140, color=EDGE))
    _arrow(axes, (x - 1.5, 0), (x + 1.5, 0), "$D_w$", at=0.8)
    tilt = math.radians(angle)
    top = np.array([x + 2.9 * math.sin(tilt), 2.9 * math.cos(tilt)])
    axes.plot([2 * x - top[0], top[0]], [-top[1], top[1]], "--", color=INK, lw=0.9)
    if angle:
        axes.text(top[0] + 0.2, 3.3, "contact angle", color=INK)
    axes.text(x - 2.1, 2.1, "$f_o D_w$", color=INK)
    axes.text(x + 0.5, -2.6, "$f_i D_w$", color=INK)
    axes.text(x - 2.3, 3.3, "outer ring", color=EDGE)
    axes.text(x - 2.3, -3.3, "inner ring", color=EDGE, va="top")


def _section_of_roller(axes: Axes, x: float, angle: float) -> None:
    from matplotlib.patches import Polygon

    shapes = (
        ([(-2.6, 1.3), (2.6, 1.3), (2.6, 2.7), (-2.6, 2.7)], STEEL, 1.0),
        ([(-1.7, -1.2), (1.7, -1.2), (1.7, 1.2), (-1.7, 1.2)], "0.95", 0.0),
        ([(-2.6, -2.7), (2.6, -2.7), (2.6, -1.3), (-2.6, -1.3)], STEEL, -0.3),
    )

    def turned(a: float, b: float, wedge: float = 0.0) -> tuple[float, float]:
        turn = math.radians(angle + 2.5 * wedge * bool(angle))
        return (
            x + a * math.cos(turn) - b * math.sin(turn),
            a * math.sin(turn) + b * math.cos(turn),
        )

    for corners, colour, wedge in shapes:
        rotated = [turned(a, b, wedge) for a, b in corners]
        axes.add_patch(Polygon(rotated, facecolor=colour, edgecolor=EDGE))
    _arrow(axes, turned(-1.7, 0), turned(1.7, 0), "L", at=0.25)
    _arrow(axes, turned(0.6, -1.2), turned(0.6, 1.2), "D", at=0.75)
    words = (
        "outer_angle above, inner_angle below" if angle else "outer ring above, inner ring below"
    )
    axes.text(x - 2.6, -4.4, words, color=INK)


def _gear(axes: Axes, *, is_helical: bool = False) -> None:
    """Draw base and tip circles, the line of action and its points."""
    alpha = math.radians(22)
    rolling = (2.0, 4.0)
    bases = [r * math.cos(alpha) for r in rolling]
    centres = np.array([0.0, 0.0]), np.array([sum(rolling), 0.0])
    for centre, base, r in zip(centres, bases, rolling, strict=True):
        _disc(axes, centre[0], centre[1], r + 0.26, facecolor="0.95", ls="-", lw=0.8)
        _disc(axes, centre[0], centre[1], r, facecolor="none", ls="--", lw=0.8)
        _disc(axes, centre[0], centre[1], base, facecolor=STEEL, lw=1.0)
        axes.plot(*centre, "+", color=EDGE)
    along = np.array([math.sin(alpha), math.cos(alpha)])
    foot = bases[0] * np.array([math.cos(alpha), -math.sin(alpha)])
    action = sum(rolling) * math.sin(alpha)
    end = foot + action * along
    axes.plot(*zip(foot, end, strict=True), color=INK, lw=1.4)
    ends = [math.sqrt((r + 0.26) ** 2 - b**2) for r, b in zip(rolling, bases, strict=True)]
    for letter, s in (("A", action - ends[1]), ("C", bases[0] * math.tan(alpha)), ("E", ends[0])):
        point = foot + s * along
        axes.plot(*point, "o", color=INK, ms=3.5)
        axes.text(point[0] + 0.1, point[1] - 0.02, letter, color=INK, va="center")
    aside = np.array([-along[1], along[0]]) * 0.3
    _arrow(axes, foot + aside, foot + aside + ends[0] * along, "s", at=0.35)
    axes.text(end[0] + 0.1, end[1] + 0.15, "line of action, length N", color=INK)
    for centre, tip, name in zip(centres, (foot, end), ("$r_{b1}$", "$r_{b2}$"), strict=True):
        _arrow(axes, centre, tip, name, ends="->", at=0.5)
    _arrow(axes, (0.0, -1.4), (6.0, -1.4), "centre distance a", at=0.7)
    if is_helical:
        axes.text(
            3.3,
            -1.95,
            "section normal to the axes; radii normal to the flanks: over cos(beta_b)",
            color=INK,
            ha="center",
            va="top",
        )
    axes.set(xlim=(-0.6, 7.2), ylim=(-1.75, 1.95))


def _cam(axes: Axes) -> None:
    """Draw an eccentric cam below a flat follower."""
    from matplotlib.patches import Rectangle

    turn = np.linspace(0, 2 * np.pi, 400)
    base, most = 1.6, 0.9

    def lift(angle: Any, order: int = 0) -> Any:  # noqa: ANN401
        shape = {0: 1 - np.cos(angle), 1: np.sin(angle), 2: np.cos(angle)}[order]
        return most / 2 * shape

    at = 2.2
    radius = base + lift(turn)
    # Envelope of the flat follower, turned so that the contact at the angle `at` lies on top.
    x = radius * np.sin(turn - at) + lift(turn, 1) * np.cos(turn - at)
    y = radius * np.cos(turn - at) - lift(turn, 1) * np.sin(turn - at)
    axes.fill(x, y, facecolor=STEEL, edgecolor=EDGE)
    _disc(axes, 0, 0, base, facecolor="none", ls="--", lw=0.8)
    axes.plot(0, 0, "+", color=EDGE)
    top, aside = base + lift(at), lift(at, 1)
    axes.add_patch(Rectangle((-1.8, top), 3.6, 0.35, facecolor="0.95", edgecolor=EDGE))
    axes.add_patch(Rectangle((-0.3, top + 0.35), 0.6, 1.1, facecolor="0.95", edgecolor=EDGE))
    axes.plot(aside, top, "o", color=INK, ms=4)
    curvature = base + lift(at) + lift(at, 2)
    _arrow(axes, (aside, top - curvature), (aside, top), "", ends="->")
    axes.text(2.7, 0.4, "rho = $r_b$ + l + l''", color=INK)
    _arrow(axes, (-2.5, 0), (-2.5, base), "$r_b$", side=-1)
    _arrow(axes, (-2.5, base), (-2.5, top), "l", side=-1)
    _arrow(axes, (0, -0.25), (aside, -0.25), "l'", side=-1)
    _arrow(axes, (0, top + 2.3), (0, top + 1.5), "load", ends="->", at=0.3)
    axes.text(
        2.2, top - 0.2, "speeds past the contact:\ncam omega rho, follower omega l''", color=INK
    )
    axes.set(xlim=(-4.2, 7.5), ylim=(-2.7, 5.0))


def _ball_on_disc(axes: Axes) -> None:
    from matplotlib.patches import Rectangle

    axes.add_patch(Rectangle((-4, -0.6), 8, 0.6, facecolor=STEEL, edgecolor=EDGE))
    _disc(axes, 0, 1.5, 1.5, facecolor="0.95")
    _arrow(axes, (-1.5, 1.5), (1.5, 1.5), "d")
    _arrow(axes, (0, 4.1), (0, 3.1), "load", ends="->", at=0.3)
    _arrow(axes, (0.4, 0.25), (1.9, 0.25), "u1", ends="->", at=1)
    _arrow(axes, (0.4, -0.3), (1.6, -0.3), "u2", ends="->", at=1)
    axes.text(-4, -1.5, "mean speed (u1 + u2)/2, slide-to-roll ratio (u1 - u2)/mean", color=INK)
    axes.set(xlim=(-5, 5), ylim=(-2, 4.4))


def _two_disc(axes: Axes) -> None:
    _disc(axes, 0, 1.7, 1.7, facecolor="0.95")
    _disc(axes, 0, -1.3, 1.3)
    _arrow(axes, (-1.7, 1.7), (1.7, 1.7), "$d_1$")
    _arrow(axes, (-1.3, -1.3), (1.3, -1.3), "$d_2$")
    _arrow(axes, (0, 4.5), (0, 3.5), "load", ends="->", at=0.3)
    _arrow(axes, (1.4, 0.15), (2.9, 0.15), "u1", ends="->", at=1)
    _arrow(axes, (1.2, -0.25), (2.4, -0.25), "u2", ends="->", at=1)
    axes.set(xlim=(-5, 5), ylim=(-3, 4.8))


DRAWINGS: dict[str, Callable[[Axes], None]] = {
    "BallOnDisc": _ball_on_disc,
    "MiniTraction": _ball_on_disc,
    "TwoDisc": _two_disc,
    "DeepGrooveBallBearing": _bearing,
    "AngularContactBallBearing": lambda axes: _bearing(axes, angle=30),
    "CylindricalRollerBearing": lambda axes: _bearing(axes, is_roller=True),
    "TaperedRollerBearing": lambda axes: _bearing(axes, is_roller=True, angle=14),
    "SpurGearPair": _gear,
    "HelicalGearPair": lambda axes: _gear(axes, is_helical=True),
    "CamFollower": _cam,
}
"""By the name of the element."""
