"""The cases of the stability map, as the groups and keys of ``ehlwave-case`` input files."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product

STIFF_CORNER = ((2000.0, 12.05, 1.0), (2000.0, 12.05, 0.04))
"""The stiffest conditions (M, L, D) of Venner, Kaneta and Lubrecht (2000)."""

# Conditions (M, L) of the wavy and dynamic cases: light, the paper's, heavy, isoviscous, viscous.
_CONDITIONS = ((3.0, 12.05), (100.0, 12.05), (1000.0, 12.05), (300.0, 0.0), (300.0, 30.0))
_DYNAMICS = {"load_balance": "equation_of_motion", "natural_frequency": 5.0, "end_time": 2.0}


@dataclass(frozen=True)
class Case:
    """One case: the family it belongs to, what it varies, and its input keys by group."""

    family: str
    variant: str
    groups: dict[str, dict[str, float | int | str]] = field(hash=False)

    def value(self, key: str, default: float | str = "") -> float | int | str:
        """Return the value of an input key in whatever group it is, else `default`."""
        for keys in self.groups.values():
            if key in keys:
                return keys[key]
        return default

    def namelist(self) -> str:
        """Return the input file."""
        lines = []
        for group, keys in self.groups.items():
            settings = ", ".join(f"{key} = {_literal(value)}" for key, value in keys.items())
            lines.append(f"&{group} {settings} /\n")
        return "".join(lines)


def quick_cases(cells: int = 128) -> list[Case]:
    """Return cases on coarse grids that take a few minutes together."""
    steady = _steady((3.0, 100.0, 1000.0, 10000.0), (0.0, 3.0, 12.05, 30.0), (0.005, 0.04, 1.0), cells)
    conditions = ((100.0, 12.05), (1000.0, 12.05), (300.0, 30.0))
    return [
        *steady,
        *_waves(conditions, (0.25, 1.0, 4.0), (0.2, 0.9), cells // 2),
        *_time_steps(conditions[:2], (0.25, 4.0), cells // 2),
        *_slip(conditions[:2], (0.0, 0.5, 2.0), cells // 2),
        *_lubricant(conditions[1:], cells // 2),
        *_dynamic(conditions[:2], cells // 2),
        *_coarse(cells // 4),
        *_outside(),
    ]


def full_cases(largest_steady: int = 512, cells: int = 128) -> list[Case]:
    """Return all cases: steady ones on grids up to `largest_steady`, the others on `cells`."""
    loads = (3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10000.0)
    ratios = (0.005, 0.04, 0.12, 0.35, 1.0)
    return [
        *_steady(loads, (0.0, 1.0, 3.0, 6.0, 12.05, 20.0, 30.0), ratios, largest_steady),
        *_waves(_CONDITIONS, (0.05, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0), (0.01, 0.2, 0.5, 0.9), cells),
        *_time_steps(_CONDITIONS, (0.25, 0.5, 2.0, 4.0), cells),
        *_slip(_CONDITIONS, (0.0, 0.25, 0.5, 1.5, 2.0), cells),
        *_lubricant(_CONDITIONS, cells),
        *_dynamic(_CONDITIONS, cells),
        *_coarse(32),
        *_outside(),
    ]


def corner_cases(cells: int = 512) -> list[Case]:
    """Return the smooth steady states of the paper's stiff corner on a fine grid."""
    return [
        _case("corner", f"{cells} cells", m, l, d, grid=_grid(cells)) for m, l, d in STIFF_CORNER
    ]


def _case(family: str, variant: str, m: float, l: float, d: float, **groups: object) -> Case:  # noqa: E741
    conditions = {"load_parameter_m": m, "lubricant_parameter_l": l, "radius_ratio_d": d}
    extra = groups.pop("conditions", {})
    given = {name: keys for name, keys in groups.items() if keys}
    return Case(family, variant, {"conditions": {**conditions, **extra}, **given})


def _grid(cells: int) -> dict[str, int]:
    return {"cells_x": cells, "cells_y": cells}


def _steady(
    loads: Sequence[float], viscous: Sequence[float], ratios: Sequence[float], largest: int
) -> Iterator[Case]:
    """Yield smooth steady states on the grid that the program chooses, up to `largest` cells."""
    grid = {"cells_x": 0, "cells_y": 0, "largest_cells": largest}
    for d, l, m in product(ratios, viscous, loads):  # noqa: E741
        yield _case("steady", "smooth", m, l, d, grid=grid)


def _waves(
    conditions: Sequence[tuple[float, float]],
    wavelengths: Sequence[float],
    amplitudes: Sequence[float],
    cells: int,
) -> Iterator[Case]:
    """Yield moving waves; the shortest ones are not resolved. Standing and slender ones too."""
    for (m, l), wave, amplitude in product(conditions, wavelengths, amplitudes):  # noqa: E741
        waviness = _transverse(wave, amplitude)
        variant = f"wave {wave:g} a, {100 * amplitude:g} %"
        yield _case("waves", variant, m, l, 1.0, waviness=waviness, grid=_grid(cells))
    for (m, l), d, orientation in product(  # noqa: E741
        conditions, (0.04, 1.0), ("isotropic", "longitudinal")
    ):
        waviness = {"orientation": orientation, "wavelength_over_a": 1.0, "amplitude_over_film": 0.9}
        grid = {"cells_x": cells, "cells_y": 0, "largest_cells": 2 * cells}
        yield _case(
            "orientation", f"{orientation}, D {d:g}", m, l, d, waviness=waviness, grid=grid
        )


def _time_steps(
    conditions: Sequence[tuple[float, float]], steps: Sequence[float], cells: int
) -> Iterator[Case]:
    for (m, l), step, amplitude in product(conditions, steps, (0.2, 0.9)):  # noqa: E741
        yield _case(
            "time step", f"{step:g} hX, {100 * amplitude:g} %", m, l, 1.0,
            waviness=_transverse(1.0, amplitude), grid=_grid(cells),
            solver={"time_step_over_cell": step},
        )  # fmt: skip


def _slip(
    conditions: Sequence[tuple[float, float]], slips: Sequence[float], cells: int
) -> Iterator[Case]:
    for (m, l), slip, amplitude in product(conditions, slips, (0.2, 0.9)):  # noqa: E741
        yield _case(
            "slip", f"slip {slip:g}, {100 * amplitude:g} %", m, l, 1.0,
            conditions={"slip_parameter": slip}, waviness=_transverse(1.0, amplitude),
            grid=_grid(cells),
        )  # fmt: skip


def _lubricant(conditions: Sequence[tuple[float, float]], cells: int) -> Iterator[Case]:
    laws = {
        "Barus": {"viscosity_law": "barus"},
        "incompressible": {"density_law": "incompressible"},
        "Barus, incompressible": {"viscosity_law": "barus", "density_law": "incompressible"},
    }
    for (m, l), (name, lubricant) in product(conditions, laws.items()):  # noqa: E741
        for amplitude in (0.2, 0.9):
            yield _case(
                "lubricant", f"{name}, {100 * amplitude:g} %", m, l, 1.0, lubricant=lubricant,
                waviness=_transverse(1.0, amplitude), grid=_grid(cells),
            )  # fmt: skip


def _dynamic(conditions: Sequence[tuple[float, float]], cells: int) -> Iterator[Case]:
    """Yield load steps of smooth and wavy contacts, with and without inertia."""
    for (m, l), factor in product(conditions, (0.5, 2.0)):  # noqa: E741
        step = {"load_factor": factor, "end_time": 2.0}
        yield _case(
            "dynamics", f"force x {factor:g}", m, l, 1.0, grid=_grid(cells), dynamics=step
        )
        yield _case(
            "dynamics", f"motion, force x {factor:g}", m, l, 1.0, grid=_grid(cells),
            dynamics={**_DYNAMICS, **step},
        )  # fmt: skip
        yield _case(
            "dynamics", f"motion, force x {factor:g}, wave", m, l, 1.0, grid=_grid(cells),
            waviness=_transverse(1.0, 0.5), dynamics={**_DYNAMICS, **step},
        )  # fmt: skip


def _coarse(cells: int) -> Iterator[Case]:
    """Yield cases on a grid far too coarse for them: they must say so."""
    for m, l, d in product((100.0, 2000.0, 10000.0), (0.0, 12.05, 30.0), (0.04, 1.0)):  # noqa: E741
        yield _case("coarse", f"{cells} cells", m, l, d, grid=_grid(cells))
    for m, l in ((2000.0, 12.05), (1000.0, 30.0)):  # noqa: E741
        yield _case(
            "coarse", f"{cells} cells, wave", m, l, 1.0, grid=_grid(cells),
            waviness=_transverse(0.25, 0.5),
        )  # fmt: skip


def _outside() -> Iterator[Case]:
    """Yield cases outside the model or the numbers allowed: they must be refused."""
    yield _case("outside", "D = 0.001", 100.0, 12.05, 0.001)
    yield _case("outside", "D = 2", 100.0, 12.05, 2.0)
    yield _case("outside", "M = 0", 0.0, 12.05, 1.0)
    yield _case("outside", "L = -1", 100.0, -1.0, 1.0)
    yield _case("outside", "M = 1e30", 1e30, 12.05, 1.0)
    yield _case("outside", "L = 1e6", 100.0, 1e6, 1.0)
    yield _case("outside", "slip 3", 100.0, 12.05, 1.0, conditions={"slip_parameter": 3.0})
    yield _case("outside", "amplitude 2", 100.0, 12.05, 1.0, waviness=_transverse(1.0, 2.0))
    yield _case(
        "outside", "slip 1e-9", 100.0, 12.05, 1.0, conditions={"slip_parameter": 1e-9},
        waviness=_transverse(1.0, 0.2),
    )  # fmt: skip


def _transverse(wavelength: float, amplitude: float) -> dict[str, float | str]:
    return {
        "orientation": "transverse",
        "wavelength_over_a": wavelength,
        "amplitude_over_film": amplitude,
    }


def _literal(value: float | str) -> str:
    return f"'{value}'" if isinstance(value, str) else repr(value)
