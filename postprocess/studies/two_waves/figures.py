"""Figures on the two waves."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ehlwave.results.case_file import read_contact
from ehlwave.results.figures import COLOURS
from studies.sweeps import fields_file, read_sweep
from studies.two_waves.fit import rms
from studies.two_waves.passing import WINDOW, Passing
from studies.two_waves.points import Pairs
from studies.two_waves.shapes import ALONG

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

Both = tuple[Complex, Complex]
"""Computed and predicted."""


def predicted_figure(trained: Both, fresh: Both) -> Figure:
    """Draw predicted against computed amplitudes, held out and at fresh conditions."""
    figure = Figure(figsize=(7.2, 3.5), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    names = ("held-out conditions", "fresh conditions")
    for axis, (computed, film), name in zip(axes, (trained, fresh), names, strict=True):
        x, y = np.abs(computed), np.abs(film)
        axis.plot([0, 1.4], [0, 1.4], color="0.6", linewidth=0.8)
        axis.scatter(x, y, s=4, color=COLOURS[0], linewidths=0, alpha=0.5, rasterized=True)
        axis.set(title=f"{name}: rms {rms(x - y):.3f}", xlabel="computed $|a+c|$")
        axis.set(xlim=(0, 1.4), ylim=(0, 1.4), aspect="equal")
    axes[0].set_ylabel("predicted $|a+c|$")
    return figure


def amplitude_figure(pairs: Pairs) -> Figure:
    """Draw |a| and |c| against the wave parameter; colours: S; Newtonian and Ree-Eyring."""
    t = pairs.table
    power = -(t["along"] / 3)
    x = 0.263 * t["wave_n"] * np.sqrt(t["load"]) * t["l"] ** power
    newtonian = (t["flow_law"] == "newtonian").to_numpy()
    carried = pairs.film - pairs.attenuated
    figure = Figure(figsize=(7.2, 5.2), layout="constrained")
    axes = figure.subplots(2, 2, sharex=True, sharey=True)
    for row, chosen, oil in ((0, newtonian, "Newtonian"), (1, ~newtonian, "Ree-Eyring")):
        for axis, wave, name in zip(axes[row], (pairs.attenuated, carried), "ac", strict=True):
            points = axis.scatter(
                x[chosen],
                np.abs(wave[chosen]),
                c=t["slip"][chosen],
                s=5,
                cmap="coolwarm",
                vmin=0.4,
                vmax=1.6,
                linewidths=0,
                rasterized=True,
            )
            axis.set(xscale="log", ylim=(0, 1.2), title=f"{oil}: $|{name}|$")
    ticks = (0.2, 0.5, 1.0, 2.0, 5.0)
    for axis in axes[1]:
        axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axis.set_xticks([], minor=True)
        axis.set_xlabel(r"$x=0.263\,(\lambda_n/a)(\gamma M)^{1/2}L^{-\cos^2\theta/3}$")
    figure.colorbar(points, ax=axes, label="$S$", shrink=0.7)
    return figure


def eyring_figure(number: Floats, found: Complex, closed: Complex, rigid: Complex) -> Figure:
    """Draw |a| against the number of an incompressible oil, and for compressible oils."""
    figure = Figure(figsize=(7.2, 3.0), layout="constrained")
    left, right = figure.subplots(1, 2)
    grid = np.geomspace(1e-2, 1e2, 200)
    left.plot(grid, 1 / np.hypot(1, 6 / np.pi**2 * grid), "k-", linewidth=1, label="incompressible")
    left.scatter(number, np.abs(closed), s=8, color=COLOURS[0], linewidths=0, label="closed form")
    left.scatter(
        number,
        np.abs(found),
        s=9,
        facecolors="none",
        edgecolors=COLOURS[1],
        linewidths=0.5,
        label="in the computed film",
    )
    left.set(ylabel="$|a|$", ylim=(0, 1.1))
    left.legend(frameon=False, fontsize=8)
    right.scatter(number, np.abs(closed / rigid), s=6, color=COLOURS[0], label="amplitude")
    turn = np.abs(np.angle(closed / rigid))
    right.scatter(number, turn, s=6, color=COLOURS[2], label="phase, rad")
    right.set(ylabel="compressible over incompressible", ylim=(0, 2.5))
    right.legend(frameon=False, fontsize=8)
    for axis in (left, right):
        axis.set(xscale="log", xlabel=r"$(\tau_0/E')(\lambda/h)^2$", xlim=(1e-2, 1e2))
    return figure


def along_figure(folder: Path) -> Figure:
    """Draw the film along the contact at an instant with its two waves, for each oil."""
    rows = read_sweep(folder, ALONG)
    figure = Figure(figsize=(7.2, 2.9), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for axis, row in zip(axes, rows, strict=True):
        fields = read_contact(fields_file(folder, ALONG, row))
        middle = int(np.argmin(np.abs(fields["y"].values)))
        x = fields["x"].values
        film = fields["film_response"].values[middle] * np.exp(
            1j * fields["film_phase"].values[middle]
        )
        _draw_along(axis, x, film, row)
    axes[0].set_ylabel("film change over $A_i$")
    axes[0].legend(frameon=False, fontsize=7.5, ncols=2, loc="lower left")
    return figure


def _draw_along(axis: Axes, x: Floats, film: Complex, row: dict[str, object]) -> None:
    def number(name: str) -> complex:
        return complex(float(row[f"{name}_real"]), float(row[f"{name}_imaginary"]))  # type: ignore[arg-type]

    kx = 2 * np.pi / float(row["wavelength_over_a"])  # type: ignore[arg-type]
    own = number("attenuated_formula") * np.exp(1j * kx * x)
    carried = (number("harmonic") - number("attenuated_formula")) * np.exp(
        1j * number("psi_formula") * x
    )
    near = np.abs(x) <= 1
    axis.plot(x[near], film.real[near], color="0.2", linewidth=2.2, label="computed")
    inside = near & (np.abs(x) <= 0.9)
    both = (own + carried).real
    axis.plot(x[inside], both[inside], "--", color=COLOURS[5], linewidth=1.2, label="both waves")
    axis.plot(x[inside], own.real[inside], color=COLOURS[0], linewidth=0.9, label="attenuated")
    axis.plot(
        x[inside], carried.real[inside], color=COLOURS[1], linewidth=0.9, label="complementary"
    )
    oil = "Newtonian" if row["flow_law"] == "newtonian" else "Ree-Eyring"
    axis.set(title=f"{oil}, S = {row['slip_parameter']:g}", xlabel="$X$", ylim=(-1.9, 1.5))


def passing_figure(passed: list[Passing]) -> Figure:
    """Draw ridge and dimple at each slip: undeformed, simulated, by computed waves, by the law."""
    shown = [one for name in ("ridge", "dimple") for one in passed if one.name == name]
    figure = Figure(figsize=(7.2, 5.4), layout="constrained")
    axes = figure.subplots(2, -(-len(shown) // 2), sharex=True, sharey="row", squeeze=False)
    styles = {
        "simulated": {"color": "0.2", "linewidth": 2.2},
        "computed waves": {"color": COLOURS[0], "linewidth": 1.1, "linestyle": "--"},
        "law": {"color": COLOURS[1], "linewidth": 1.1},
    }
    for axis, one in zip(axes.flat, shown, strict=True):
        undeformed = axis.plot(one.x, -one.surface, color="0.75", linewidth=1.2)
        lines = [axis.plot(one.x, one.lines[name], **style)[0] for name, style in styles.items()]
        axis.axvspan(-WINDOW, WINDOW, color="0.95", zorder=-1)
        errors = ", ".join(f"{name} {100 * one.error(name):.1f} %" for name in list(styles)[1:])
        axis.set_title(f"{one.name}, S = {one.slip:g}; error over Rq:\n{errors}", fontsize=8)
    for axis in axes[-1]:
        axis.set_xlabel("$X$")
    figure.supylabel("film less smooth film over height, $Y = 0$", fontsize=8.5)
    labels = ["undeformed", *styles]
    figure.legend([*undeformed, *lines], labels, loc="outside lower center", ncols=4, frameon=False)
    return figure
