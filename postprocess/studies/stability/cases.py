"""The cases of the stability map, as the groups and keys of ``ehlwave-case`` input files."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product

STIFF_CORNER = ((2000.0, 12.05, 1.0), (2000.0, 12.05, 0.04))
"""The stiffest conditions (M, L, D) of Venner, Kaneta and Lubrecht (2000)."""

# Conditions of the wavy and dynamic cases, and the cells along X and Y that resolve their inlet.
_CONDITIONS = (
    (10.0, 12.05, 128, 64),  # light
    (100.0, 12.05, 128, 64),  # the paper's
    (1000.0, 12.05, 192, 128),
    (300.0, 0.0, 192, 128),  # isoviscous
    (300.0, 30.0, 128, 64),  # very viscous
)
# Conditions of a sliding Ree-Eyring oil with their cells, on a line (D = 0) along X only.
_SLIDING_CONDITIONS = (
    (30.0, 6.0, 1.0, 64, 64),
    (30.0, 12.05, 1.0, 64, 64),
    (100.0, 12.05, 1.0, 64, 64),
    (100.0, 30.0, 1.0, 64, 64),
    (300.0, 12.05, 1.0, 128, 64),
    (30.0, 6.0, 0.12, 64, 64),
    (100.0, 12.05, 0.12, 64, 64),
    (300.0, 12.05, 0.12, 128, 64),
    (30.0, 6.0, 0.0, 256, 0),
    (100.0, 12.05, 0.0, 512, 0),
    (300.0, 12.05, 0.0, 1024, 0),
)
SLIDING = "sliding"
"""Begins the name of a family of cases with a Ree-Eyring oil: one for each tau0."""
STARVED = "starved"
"""Begins the name of a family of contacts with too little oil: one for each D."""
OUTSIDE = "outside"
"""The family of cases that must be refused."""

_POINTS_PER_WAVE = 8
_LENGTH = 4.0  # length of the default domain along X
_MOTION = {"load_balance": "equation_of_motion", "natural_frequency": 5.0}
_Condition = tuple[float, float, int, int]
_Keys = Mapping[str, float | int | str]


@dataclass(frozen=True)
class Case:
    """A case: its family, its variation, and its input keys by group."""

    family: str
    variant: str
    groups: Mapping[str, _Keys] = field(hash=False)

    def value(self, key: str, default: float | str = "") -> float | int | str:
        """Return the value of an input key in whatever group it is, else `default`."""
        for keys in self.groups.values():
            if key in keys:
                return keys[key]
        return default


def quick_cases() -> list[Case]:
    """Return some of the cases, on grids of at most 128 cells: a few minutes on two cores."""
    conditions = tuple(condition for condition in _CONDITIONS if condition[2] == 128)
    steady = (0.0, 3.0, 12.05, 30.0), (0.005, 0.04, 1.0), 128
    return [
        *_steady((3.0, 100.0, 1000.0, 10000.0), *steady),
        *_waves(conditions, (0.25, 1.0, 4.0), (0.2, 0.9)),
        *_unresolved_waves(conditions[:2], (0.05,)),
        *_orientations(conditions[1:2], (0.04, 1.0)),
        *_time_steps(conditions[1:], (0.25, 4.0)),
        *_slip(conditions[1:], (0.0, 2.0)),
        *_lubricant(conditions[1:]),
        *_dynamic(conditions[1:]),
        *_coarse(),
        *_outside(),
    ]


def full_cases() -> list[Case]:
    """Return all cases except the corner."""
    return [*steady_cases(), *wavy_cases()]


def steady_cases() -> list[Case]:
    """Return smooth steady states on grids of up to 256 cells."""
    loads = (3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10000.0)
    viscous = (0.0, 1.0, 3.0, 6.0, 12.05, 20.0, 30.0)
    return [
        *_steady(loads, viscous, (0.005, 0.04, 0.12, 0.35, 1.0), 256),
        *_wide((3.0, 10.0), (0.0, 12.05, 30.0), (0.35, 1.0)),
    ]


def wavy_cases() -> list[Case]:
    """Return marches, stationary patterns, and cases that are too coarse or out of range."""
    return [
        *_waves(_CONDITIONS, (0.25, 0.5, 1.0, 2.0, 4.0), (0.2, 0.9)),
        *_waves(_CONDITIONS, (1.0,), (0.01, 0.5)),
        *_waves(_CONDITIONS[1:2], (0.05,), (0.2, 0.9)),
        *_waves(_CONDITIONS[1:3], (0.125,), (0.2, 0.9)),
        *_unresolved_waves(_CONDITIONS, (0.05, 0.125)),
        *_orientations(_CONDITIONS, (0.04, 1.0)),
        *_time_steps(_CONDITIONS, (0.25, 0.5, 2.0, 4.0)),
        *_slip(_CONDITIONS, (0.0, 0.25, 0.5, 1.5, 2.0)),
        *_lubricant(_CONDITIONS),
        *_dynamic(_CONDITIONS),
        *_coarse(),
        *_outside(),
    ]


def corner_cases(cells: int = 512) -> list[Case]:
    """Return the smooth steady states of the paper's stiff corner on a fine grid."""
    return [
        _case("corner", f"{cells} cells", m, l, d, grid=_grid(cells)) for m, l, d in STIFF_CORNER
    ]


def sliding_cases() -> list[Case]:
    """Return smooth steady states of a Ree-Eyring oil with their linear responses.

    S = 1.5 is solved a second time, to a smaller tolerance and, but for lines, by FAS.
    """
    waviness = {"orientation": "transverse", "wavelength_over_a": 1.0, "response": "harmonic"}
    slips = {f"S {slip:g}": (slip, {}) for slip in (0.0, 0.5, 1.0, 1.5, 2.0)}
    slips["S 1.5 again"] = (1.5, {"tolerance": 1e-8})
    cases = []
    for stress, (m, l, d, x, y) in product((0.5e6, 5e6, 50e6), _SLIDING_CONDITIONS):
        family = f"{SLIDING}, {stress / 1e6:g} MPa"
        for variant, (slip, keys) in slips.items():
            groups = {
                "conditions": {"slip_parameter": slip, "reduced_modulus_pa": 2.26e11},
                "lubricant": {"flow_law": "eyring", "eyring_stress_pa": stress},
                "grid": {"cells_x": x, "cells_y": y} if d > 0 else {"cells_x": x},
                "solver": {**keys, "method": "fas"} if keys and d > 0 else keys,
            }
            cases.append(_case(family, variant, m, l, d, waviness=waviness, **groups))
    return cases


def starved_cases(largest: int = 192) -> list[Case]:
    """Return contacts with 0.3 to 3 times the oil that they pass flooded, with small waves.

    Edges are flooded and the inlet is long, so that the meniscus lies within the domain.
    """
    grid: dict[str, float | str] = {"largest_cells": largest, "x_min": -4.5, "edges": "flooded"}
    grid |= {"cells_x": 0, "cells_y": 0}
    waviness = {"orientation": "transverse", "wavelength_over_a": 1.0, "response": "harmonic"}
    contacts = product((1.0, 0.3, 0.1), (20.0, 100.0, 300.0, 1000.0), (2.0, 6.0, 12.05, 20.0))
    return [
        _case(
            f"{STARVED}, D {d:g}", f"r {r:g}", m, l, d,
            inlet={"oil_over_flooded": r}, waviness=waviness, grid=grid,
        )
        for (d, m, l), r in product(contacts, (0.3, 0.5, 0.8, 1.2, 3.0))
    ]  # fmt: skip


def _case(family: str, variant: str, m: float, l: float, d: float, **groups: object) -> Case:
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
    for d, l, m in product(ratios, viscous, loads):
        yield _case("steady", "smooth", m, l, d, grid=grid)


def _wide(
    loads: Sequence[float], viscous: Sequence[float], ratios: Sequence[float]
) -> Iterator[Case]:
    """Yield light contacts, whose thick film needs a longer and wider domain."""
    grid = {"x_min": -8.0, "x_max": 2.0, "y_max": 4.0, "cells_x": 256, "cells_y": 192}
    for d, l, m in product(ratios, viscous, loads):
        yield _case("steady", "wide domain", m, l, d, grid=grid)


def _waves(
    conditions: Sequence[_Condition], wavelengths: Sequence[float], amplitudes: Sequence[float]
) -> Iterator[Case]:
    """Yield moving waves on grids that resolve them."""
    for (m, l, x, y), wave, amplitude in product(conditions, wavelengths, amplitudes):
        fine = max(x, round(_POINTS_PER_WAVE * _LENGTH / wave))
        yield _wavy("waves", f"{wave:g} a, {_percent(amplitude)}", (m, l, fine, y), wave, amplitude)


def _unresolved_waves(
    conditions: Sequence[_Condition], wavelengths: Sequence[float]
) -> Iterator[Case]:
    for condition, wave in product(conditions, wavelengths):
        yield _wavy("waves", f"{wave:g} a, coarse", condition, wave, 0.2)


def _orientations(conditions: Sequence[_Condition], ratios: Sequence[float]) -> Iterator[Case]:
    """Yield patterns that vary across, resolved in Y too."""
    orientations = ("isotropic", "longitudinal")
    for (m, l, x, y), d, orientation in product(conditions, ratios, orientations):
        waviness = {
            "orientation": orientation,
            "wavelength_over_a": 1.0,
            "amplitude_over_film": 0.9,
        }
        grid = {"cells_x": x, "cells_y": 256 if d < 0.1 else y}
        variant = f"{orientation}, D {d:g}"
        yield _case("orientation", variant, m, l, d, waviness=waviness, grid=grid)


def _time_steps(conditions: Sequence[_Condition], steps: Sequence[float]) -> Iterator[Case]:
    keys = {f"{step:g} hX,": {"time_step_over_cell": step} for step in steps}
    return _varied("time step", conditions, "solver", keys)


def _slip(conditions: Sequence[_Condition], slips: Sequence[float]) -> Iterator[Case]:
    keys = {f"S {slip:g},": {"slip_parameter": slip} for slip in slips}
    return _varied("slip", conditions, "conditions", keys)


def _lubricant(conditions: Sequence[_Condition]) -> Iterator[Case]:
    barus = {"viscosity_law": "barus"}
    incompressible = {"density_law": "incompressible"}
    laws = {"B.": barus, "inc.": incompressible, "B. inc.": {**barus, **incompressible}}
    return _varied("lubricant", conditions, "lubricant", laws)


def _varied(
    family: str, conditions: Sequence[_Condition], group: str, variants: Mapping[str, _Keys]
) -> Iterator[Case]:
    """Yield waves of two heights with the keys of each variant."""
    for condition, (name, keys), amplitude in product(conditions, variants.items(), (0.2, 0.9)):
        variant = f"{name} {_percent(amplitude)}"
        yield _wavy(family, variant, condition, 1.0, amplitude, **{group: keys})


def _dynamic(conditions: Sequence[_Condition]) -> Iterator[Case]:
    """Yield load steps of smooth and wavy contacts, without inertia and with it."""
    for condition, factor in product(conditions, (0.5, 2.0)):
        m, l, x, y = condition
        grid = {"cells_x": x, "cells_y": y}
        step = {"load_factor": factor, "end_time": 2.0}
        name = f"F x {factor:g}"
        yield _case("dynamics", name, m, l, 1.0, grid=grid, dynamics=step)
        motion = {**_MOTION, **step}
        yield _case("dynamics", f"{name}, motion", m, l, 1.0, grid=grid, dynamics=motion)
        yield _wavy("dynamics", f"{name}, m., wave", condition, 1.0, 0.5, dynamics=motion)


def _coarse(cells: int = 32) -> Iterator[Case]:
    """Yield cases on a grid far too coarse for them: they must report it."""
    for m, l in product((300.0, 2000.0, 10000.0), (0.0, 12.05, 30.0)):
        yield _case("coarse", f"{cells} cells", m, l, 1.0, grid=_grid(cells))
    for m, l in ((100.0, 12.05), (2000.0, 12.05), (2000.0, 30.0)):
        yield _wavy("coarse", f"{cells} cells, wave", (m, l, cells, cells), 0.25, 0.5)


def _outside() -> Iterator[Case]:
    """Yield cases outside the model or the numbers allowed: they must be refused."""
    yield _case(OUTSIDE, "D = 0.001", 100.0, 12.05, 0.001)
    yield _case(OUTSIDE, "D = 2", 100.0, 12.05, 2.0)
    yield _case(OUTSIDE, "M = 0", 0.0, 12.05, 1.0)
    yield _case(OUTSIDE, "L = -1", 100.0, -1.0, 1.0)
    yield _case(OUTSIDE, "M = 1e30", 1e30, 12.05, 1.0)
    yield _case(OUTSIDE, "L = 1e6", 100.0, 1e6, 1.0)
    yield _case(OUTSIDE, "S = 3", 100.0, 12.05, 1.0, conditions={"slip_parameter": 3.0})
    usual = (100.0, 12.05, 128, 64)
    yield _wavy(OUTSIDE, "amplitude 200 %", usual, 1.0, 2.0)
    yield _wavy(OUTSIDE, "S = 1e-9", usual, 1.0, 0.2, conditions={"slip_parameter": 1e-9})


def _wavy(
    family: str,
    variant: str,
    condition: _Condition,
    wavelength: float,
    amplitude: float,
    **groups: _Keys,
) -> Case:
    """Return a circular contact with transverse waves."""
    m, l, x, y = condition
    waviness = {
        "orientation": "transverse",
        "wavelength_over_a": wavelength,
        "amplitude_over_film": amplitude,
    }
    grid = {"cells_x": x, "cells_y": y}
    return _case(family, variant, m, l, 1.0, waviness=waviness, grid=grid, **groups)


def _percent(amplitude: float) -> str:
    return f"{100 * amplitude:g} %"
