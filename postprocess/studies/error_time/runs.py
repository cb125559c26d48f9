"""The runs: contacts, methods, grids, time steps and tolerances."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

METHODS = ("newton", "fas", "petsc")
"""Values of the key ``method``; those that a build refuses are left out."""

TIGHT = 1e-6
"""Step tolerance that algebraic errors are measured against."""


class Contact(NamedTuple):
    """A contact; wavelength over a is 0 and the orientation ``none`` where it is smooth."""

    m: float
    d: float
    wavelength: float = 0.0
    orientation: str = "none"
    lubricant_l: float = 12.05
    slip: float = 1.0
    law: str = "newtonian"

    @property
    def title(self) -> str:
        """Short text for figures and logs."""
        text = f"M = {self.m:g}, D = {self.d:g}"
        if self.lubricant_l != Contact._field_defaults["lubricant_l"]:
            text += f", L = {self.lubricant_l:g}"
        if self.wavelength:
            text += f", {self.orientation}, λ/a = {self.wavelength:g}"
        if self.slip != 1:
            text += f", S = {self.slip:g}"
        if self.law != "newtonian":
            text += f", {self.law}"
        return text


@dataclass(frozen=True)
class Run:
    """A case. The fields, in this order, identify a row of the table."""

    m: float
    d: float
    wavelength: float
    orientation: str
    lubricant_l: float
    slip: float
    law: str
    cells: int
    method: str = "newton"
    deformation: str = "fft"
    tolerance: float = 1e-6
    step_tolerance: float = 1e-4
    time_step_over_cell: float = 1.0


@dataclass(frozen=True)
class Extent:
    """How much is run: numbers of cells for each purpose, time steps, tolerances."""

    steady_cells: tuple[int, ...]
    tolerances: tuple[float, ...]
    wave_cells: tuple[int, ...]
    largest: tuple[tuple[Contact, int], ...]
    series_cells: tuple[int, ...]
    step_tolerances: tuple[float, ...]
    time_steps: tuple[float, ...]
    other_cells: tuple[int, ...]
    petsc_cells: tuple[int, ...]
    further: tuple[Contact, ...]
    further_cells: tuple[int, ...]


SMOOTH = tuple(Contact(m, d) for m in (100.0, 1000.0) for d in (1.0, 0.12))
WAVY = tuple(
    Contact(smooth.m, smooth.d, wave, "transverse") for smooth in SMOOTH for wave in (0.5, 2.0)
)
FURTHER = (
    Contact(50.0, 1.0, 1.0, "transverse", 5.0),
    Contact(200.0, 0.35, 1.0, "transverse", 20.0),
    *(
        Contact(m, d, 1.0, orientation)
        for m, d in ((100.0, 1.0), (500.0, 0.35), (100.0, 0.12))
        for orientation in ("isotropic", "longitudinal")
    ),
    *(
        Contact(100.0, 1.0, 1.0, "transverse", slip=slip, law=law)
        for slip in (0.5, 1.5)
        for law in ("newtonian", "eyring")
    ),
)
"""Contacts that the models are fitted to as well."""

FULL = Extent(
    steady_cells=(64, 128, 256, 512),
    tolerances=(1e-2, 1e-4, 1e-8),
    wave_cells=(32, 48, 64, 96, 128, 192, 256),
    largest=((WAVY[0], 384), (WAVY[7], 384), (WAVY[0], 512)),
    series_cells=(64, 128),
    step_tolerances=(1e-1, 1e-2, 1e-3, 1e-5, TIGHT),
    time_steps=(0.25, 0.5, 2.0, 4.0),
    other_cells=(64, 128, 256),
    petsc_cells=(64,),
    further=FURTHER,
    further_cells=(32, 48, 64, 96, 128),
)
QUICK = Extent(
    steady_cells=(32, 64, 128, 256),
    tolerances=(1e-2, 1e-8),
    wave_cells=(32, 48, 64, 96),
    largest=(),
    series_cells=(64,),
    step_tolerances=(1e-1, TIGHT),
    time_steps=(0.5, 2.0, 4.0),
    other_cells=(64,),
    petsc_cells=(),
    further=FURTHER,
    further_cells=(32, 48, 64),
)


def all_runs(extent: Extent, methods: tuple[str, ...] = METHODS) -> list[Run]:
    """Return every run once."""
    runs = (*_steady(extent), *_moving(extent), *_further(extent))
    return list(dict.fromkeys(run for run in runs if run.method in methods))


def _steady(extent: Extent) -> Iterator[Run]:
    for contact in SMOOTH:
        for cells in extent.steady_cells:
            base = Run(*contact, cells)
            for method in METHODS:
                yield replace(base, method=method)
            yield replace(base, deformation="mlmi")
            for tolerance in extent.tolerances:
                yield replace(base, tolerance=tolerance)


def _moving(extent: Extent) -> Iterator[Run]:
    for contact in WAVY:
        base = Run(*contact, 0)
        for cells in extent.wave_cells:
            yield replace(base, cells=cells)
        for cells in extent.series_cells:
            for tolerance in extent.step_tolerances:
                yield replace(base, cells=cells, step_tolerance=tolerance)
            for step in extent.time_steps:
                # Shorter steps than hX give the same solution at the same times: once is enough.
                if step > 1 or cells == min(extent.series_cells):
                    yield replace(base, cells=cells, time_step_over_cell=step)
        for cells in extent.other_cells:
            yield replace(base, cells=cells, deformation="mlmi")
            yield replace(base, cells=cells, method="fas")
            yield replace(base, cells=cells, time_step_over_cell=2.0)
        for cells in extent.petsc_cells:
            yield replace(base, cells=cells, method="petsc")
    for contact, cells in extent.largest:
        yield Run(*contact, cells)


def _further(extent: Extent) -> Iterator[Run]:
    for contact in extent.further:
        for cells in extent.further_cells:
            yield Run(*contact, cells)
