"""The effect of lubrication on the stress of a rough surface, and on each of two bodies.

``python -m studies.stress --output DIR`` computes the tables and pictures of ``record/stress``:
waves of one length, and random roughness, in a contact of 1.5 GPa; dry, lubricated and smooth side
by side. Nothing is simulated.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ehlwave import Contact
from ehlwave.laws.atlas_transfer import AtlasTransfer, with_atlas_film
from ehlwave.laws.transfer import FormulaBasis, Transfer
from ehlwave.results.figures import COLOURS, write_figure
from ehlwave.stress.figures import STYLE
from ehlwave.stress.rough import RoughStress, rough_stress
from ehlwave.surface import Conditions, Surface, deform_surface
from ehlwave.writing import Writer
from studies.command import maps
from studies.command.options import step_parser

Floats = NDArray[np.float64]

CONTACT = {
    "radius_x_m": 12.5e-3,
    "radius_y_m": 12.5e-3,
    "reduced_modulus_pa": 2.26e11,
    "load_n": 213.0,
    "mean_speed_m_per_s": 0.5,
    "viscosity_pa_s": 0.05,
    "eyring_stress_pa": 5e6,
}
"""Steel, 1.5 GPa, M = 700, L = 10."""

CYCLES = 7.2e5
"""Of the published model."""

DRY_FRICTION = 0.12
WAVES = (0.1, 0.2, 0.5, 1.0)
SLIPS = (0.6, 0.8, 0.95, 1.0, 1.05, 1.2, 1.4)
ORIENTATIONS = ("transverse", "isotropic", "longitudinal")
AMPLITUDE = 0.3
"""Over the film: up to here predictions are held to marches."""

LAMBDA_RATIOS = (10.0, 5.0, 3.0, 2.0, 1.0, 0.5)
"""Film over Rq of random roughness; below 3 an extrapolation of small waves."""

SMOOTHEST, ROUGHEST, MODES = 1.0, 0.1, 24
"""Longest and shortest wave of random roughness, over a, and how many there are."""


@dataclass(frozen=True)
class Dry(FormulaBasis):
    """Waves that are pressed flat: none of them is left in the gap."""

    conditions: Conditions
    name: str = "dry: pressed flat"

    def ratio(self, per_length_x: Floats, per_length_y: Floats) -> Floats:
        """Return 0."""
        return np.zeros(np.broadcast_shapes(per_length_x.shape, per_length_y.shape))


def surface_of(heights: Floats, step_m: float, orientation: str) -> Surface:
    """Return heights along a line as ridges across or along rolling, or as their product."""
    if orientation == "transverse":
        return Surface(heights[:, None], step_m, 0.0, orientation)
    if orientation == "longitudinal":
        return Surface(heights[None, :], 0.0, step_m, orientation)
    largest = np.abs(heights).max()
    return Surface(np.outer(heights, heights) / largest, step_m, step_m, orientation)


def wave(length_m: float, amplitude_m: float, orientation: str) -> Surface:
    """Return four waves."""
    x = np.arange(64) / 16
    return surface_of(amplitude_m * np.cos(2 * np.pi * x), length_m / 16, orientation)


def roughness(semi_axis_m: float, rq_m: float, orientation: str, seed: int = 5) -> Surface:
    """Return random waves that repeat after 4 a; as steep for long waves as for short ones."""
    x, random = np.arange(640) / 640, np.random.default_rng(seed)
    numbers = np.unique(np.geomspace(4 / SMOOTHEST, 4 / ROUGHEST, MODES).round())
    phases = random.uniform(0, 2 * np.pi, numbers.size)
    heights = (np.cos(2 * np.pi * x[:, None] * numbers + phases) / numbers).sum(axis=1)
    heights *= rq_m / heights.std()
    return surface_of(heights, 4 * semi_axis_m / x.size, orientation)


def stresses(contact: Contact, surface: Surface, kind: str) -> RoughStress:
    """Return the stresses with this surface, ``"dry"`` or ``"lubricated"``."""
    conditions = with_atlas_film(contact.conditions)
    transfer: Transfer = Dry(conditions) if kind == "dry" else AtlasTransfer(conditions)
    friction = DRY_FRICTION if kind == "dry" else contact.film().friction or 0.0
    deformed = deform_surface(surface, conditions, transfer, "none", "none")
    return rough_stress([deformed], friction, CYCLES)


def rows_of(result: RoughStress, **inputs: Any) -> Iterator[dict[str, Any]]:  # noqa: ANN401
    """Yield a row a body."""
    for body in result.bodies:
        yield inputs | {
            "body": "rough" if body.is_rough else "smooth",
            "ripple_rq_mpa": result.ripple_rq_pa * 1e-6,
            "ripple_shear_mpa": body.ripple_shear.value_pa * 1e-6,
            "near_um": body.near_m * 1e6,
            "dang_van_near": body.dang_van_near,
            "dang_van_near_smooth": body.dang_van_near_smooth,
            "dang_van": body.dang_van,
            "dang_van_smooth": body.dang_van_smooth,
            "share_at_risk": body.share_at_risk,
            "life_ratio": body.life_ratio,
        }


def wave_table() -> pd.DataFrame:
    """Return stresses of waves of one length, orientation and slip; dry and lubricated."""
    rows: list[dict[str, Any]] = []
    for slip in SLIPS:
        contact = Contact(**CONTACT, slip_parameter=slip)
        film, a = contact.film().central_m or np.nan, contact.conditions.semi_axis_a_m
        for length in WAVES:
            for orientation in ORIENTATIONS:
                surface = wave(length * a, AMPLITUDE * film, orientation)
                for kind in ("lubricated", "dry"):
                    inputs = {"slip_parameter": slip, "wavelength_over_a": length}
                    inputs |= {"orientation": orientation, "kind": kind}
                    rows += rows_of(stresses(contact, surface, kind), **inputs)
    return pd.DataFrame(rows)


def roughness_table() -> pd.DataFrame:
    """Return stresses of random roughness over film over Rq, of the faster and the slower body."""
    rows: list[dict[str, Any]] = []
    for slip in (1.1, 0.9):
        contact = Contact(**CONTACT, slip_parameter=slip)
        film, a = contact.film().central_m or np.nan, contact.conditions.semi_axis_a_m
        for ratio in LAMBDA_RATIOS:
            for orientation in ("transverse", "longitudinal"):
                surface = roughness(a, film / ratio, orientation)
                for kind in ("lubricated", "dry"):
                    inputs = {"slip_parameter": slip, "film_over_rq": ratio}
                    inputs |= {"orientation": orientation, "kind": kind}
                    rows += rows_of(stresses(contact, surface, kind), **inputs)
    return pd.DataFrame(rows)


def waves_figure(table: pd.DataFrame) -> Figure:
    """Draw the largest shear of the ripple over S, by wavelength and orientation."""
    with rc_context(STYLE):
        figure = Figure(figsize=(8.6, 3.2), layout="constrained")
        panels = figure.subplots(1, 3, sharey=True)
        for axes, orientation in zip(panels, ORIENTATIONS, strict=True):
            chosen = table[(table.orientation == orientation) & (table.body == "smooth")]
            for length, colour in zip(WAVES, COLOURS, strict=False):
                for kind, style in (("lubricated", "o-"), ("dry", ":")):
                    part = chosen[(chosen.wavelength_over_a == length) & (chosen.kind == kind)]
                    label = f"{length:g}" if kind == "lubricated" else None
                    shear = part.ripple_shear_mpa
                    axes.plot(part.slip_parameter, shear, style, color=colour, ms=3, label=label)
            axes.set(title=orientation, xlabel="$S$ of the rough surface", yscale="log")
        panels[0].set_ylabel("largest shear of the ripple [MPa]")
        panels[0].plot([], [], ":", color="0.4", label="dry")
        figure.legend(*panels[0].get_legend_handles_labels(), title=r"$\lambda/a$",
                      loc="outside right center", frameon=False)  # fmt: skip
    return figure


def ranking_figure(table: pd.DataFrame) -> Figure:
    """Draw the share of the surface at risk over film over roughness, by body and orientation."""
    with rc_context(STYLE):
        figure = Figure(figsize=(8.6, 3.3), layout="constrained")
        panels = figure.subplots(1, 3, sharey=True)
        lubricated = table[table.kind == "lubricated"]
        names = ((1.1, "rough body faster"), (0.9, "rough body slower"))
        for axes, (slip, name) in zip(panels, names, strict=False):
            _share_lines(axes, lubricated[lubricated.slip_parameter == slip])
            axes.set_title(name)
        _share_lines(panels[2], table[(table.kind == "dry") & (table.slip_parameter == 1.1)])
        panels[2].set_title("dry, rough body faster")
        panels[0].set_ylabel("share of surface at risk [%]")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center",
                      ncols=4, frameon=False)  # fmt: skip
    return figure


def _share_lines(axes: Axes, table: pd.DataFrame) -> None:
    for orientation, colour in (("transverse", COLOURS[0]), ("longitudinal", COLOURS[1])):
        for body, style in (("smooth", "o-"), ("rough", "s--")):
            part = table[(table.orientation == orientation) & (table.body == body)]
            share = 100 * part.share_at_risk
            label = f"{orientation}, {body} body"
            axes.plot(part.film_over_rq, share, style, color=colour, ms=3.5, label=label)
    axes.axvspan(0.4, 3, color="0.93", zorder=0)
    axes.set(xscale="log", xlabel="film over $R_q$", xlim=(0.4, 12))
    axes.set_xticks([0.5, 1, 2, 5, 10], ["0.5", "1", "2", "5", "10"])


def main(arguments: Sequence[str] | None = None) -> int:
    """Compute the study; return 0."""
    parser = step_parser(maps.stress, __doc__)
    folder = parser.parse_args(arguments).output
    writer = Writer()
    writer.folder(folder)
    for name, table, draw in (
        ("waves", wave_table(), waves_figure),
        ("roughness", roughness_table(), ranking_figure),
    ):
        writer.table(folder / f"{name}.csv", table, index=False, float_format="%.4g")
        for path in write_figure(draw(table), folder, name, dots_per_inch=110, writer=writer):
            print(path)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
