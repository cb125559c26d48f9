"""The deformed surface inside the contact, component by component (section 3.4 of the paper)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.line_contact import TRANSVERSE_ALONE
from ehlwave.errors import SurfaceError
from ehlwave.extras import load
from ehlwave.laws.asked import Asked
from ehlwave.laws.law_list import transfer_for
from ehlwave.laws.transfer import FormulaBasis, Transfer
from ehlwave.quantities import number, plain
from ehlwave.shown import Shown, micrometres, within
from ehlwave.surface.prepare import Form, Window, judged_part, remove_form
from ehlwave.surface.removal import Band
from ehlwave.surface.rough_pressure import ripple_of
from ehlwave.surface.roughness import gaussian_filtered, roughness_parameters
from ehlwave.surface.spectrum import Spectrum, Unjudged
from ehlwave.surface.statistics import (
    Components,
    FilmStatistics,
    doubts_of,
    film_statistics,
    warnings_of,
)
from ehlwave.surface.superposition import superposed
from ehlwave.surface.surface import Heights, Surface, checked_surface

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SINGLE_PRECISION_POINTS = 2**22
"""Maps with more points than this are transformed in single precision (relative error 1e-6)."""

Cutoffs = tuple[float | None, float | None]
"""Long and short cut-off of a filter, lambda_c and lambda_s, m."""


@dataclass(frozen=True, repr=False)
class Deformed(Shown):
    """A surface before and after it enters the contact.

    Attributes
    ----------
    surface : Surface
        Surface of the prediction: the form removed, nothing else changed. m.
    height : ndarray, shape (nx, ny)
        Deformed heights, m, positive out of the material: the film at the contact centre when the
        point (x, y) of the surface passes it is ``statistics.mean_film_m`` less this.
    conditions, transfer_name, form, window, cutoffs_m
        Its transfer.
    spectra : dict of Spectrum
        Mean square of the components before and after, along ``"x"`` and along ``"y"``.
    statistics : FilmStatistics
        Roughness and film thickness.
    unjudged : list of Unjudged
        Components outside the range of the formula or table, by reason.
    warnings : list of str
        Reasons for doubt.
    error_m : float or None
        Root mean square error of the deformed heights by the errors of the responses, m; None: the
        transfer has none.
    transfer : Transfer or None
        Its transfer.
    bands : list of Band
        Gradient of the lambda ratio by the waves of each band, the band to remove first first.
    """

    surface: Surface
    height: Heights
    conditions: Conditions
    transfer_name: str
    form: Form
    window: Window
    spectra: dict[str, Spectrum]
    statistics: FilmStatistics
    unjudged: list[Unjudged] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    error_m: float | None = None
    cutoffs_m: Cutoffs = (None, None)
    transfer: Transfer | None = field(default=None, repr=False, compare=False)
    bands: list[Band] = field(default_factory=list, repr=False)

    def _shown_rows(self) -> dict[str, str]:
        """Return the results of the prediction."""
        s = self.statistics
        rows = {"surface": self.surface.name}
        if s.lambda_ratio_after is not None:
            rows["lambda ratio"] = within(s.lambda_ratio_after, s.lambda_error)
        rows["mean film"] = micrometres(s.mean_film_m)
        rows["Rq"] = f"{micrometres(s.rq_before_m)} before, {micrometres(s.rq_after_m)} after"
        return rows | {"by": self.transfer_name, "warnings": str(len(self.warnings))}

    def to_topography(self) -> Any:  # noqa: ANN401 - of a package that need not be there
        """Return the deformed heights as an object of SurfaceTopography, in metres.

        Raises
        ------
        SurfaceError
            If SurfaceTopography is not installed.
        """
        return replace(self.surface, height=self.height).to_topography()

    def plot(self) -> Figure:
        """Draw the surface before, in the contact, and the difference.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it; ``savefig`` writes it.
        """
        return load("ehlwave.surface.figures").deformed_figure(self)

    @cached_property
    def pressure_pa(self) -> Heights:
        """Pressure ripple, Pa: at the contact centre as each point of the surface passes it.

        Shape of the heights. It adds to the pressure of the smooth contact.

        Raises
        ------
        StressError
            If the contact was given without the lengths that pressures need.
        """
        return ripple_of(self, every_line=True).pressure()[: self.height.shape[0]]

    @property
    def doubts(self) -> list[str]:
        """Return why numbers are extrapolated, or not there; part of the warnings."""
        return doubts_of(self.statistics, self.conditions)

    @cached_property
    def parameters(self) -> dict[str, dict[str, float]]:
        """Height parameters ``"before"`` and ``"after"`` by their names in ISO 21920 and 25178.

        See :func:`ehlwave.surface.roughness.roughness_parameters`; sections are as long as the long
        cut-off.
        """
        shape = self.height.shape
        part = judged_part((shape[0], shape[1]), self.window)
        section, cutoff = None, self.cutoffs_m[0]
        if cutoff is not None and self.surface.is_trace:
            section = round(cutoff / max(self.surface.step_x_m, self.surface.step_y_m))
        return {
            name: roughness_parameters(heights[part], self.surface.is_trace, section)
            for name, heights in (("before", self.surface.height), ("after", self.height))
        }


def deform_surface(
    surface: Surface,
    conditions: Conditions,
    transfer: Transfer | None = None,
    form: Form = "plane",
    window: Window = "mirror",
    cutoffs_m: Cutoffs = (None, None),
    boundary_film_m: float | None = None,
) -> Deformed:
    """Predict the shape of a surface inside the contact, without a simulation.

    The surface is decomposed into its Fourier components, each is multiplied by its transfer, and
    the sum is taken again. Linear: meant for amplitudes that are small against the film. The mean
    film is to second order where the transfer has rises, the contribution of each component. In
    pure rolling larger rises of wavy surfaces are of averaged flow, see
    :mod:`ehlwave.surface.averaged_film`.

    Parameters
    ----------
    surface : Surface
        A trace or a map.
    conditions : Conditions
        Of the contact.
    transfer : Transfer, optional
        Formula (18) with the paper's coefficients if absent.
    form : {"none", "mean", "plane", "quadratic"}
        Polynomial to remove first, see :func:`ehlwave.surface.prepare.remove_form`.
    window : {"mirror", "taper", "none"}
        Treatment of the ends, see :mod:`ehlwave.surface.prepare`.
    cutoffs_m : pair of float, optional
        lambda_c and lambda_s of Gaussian filters, m; waves longer than the first, and shorter than
        the second, are taken out before. None: not filtered.
    boundary_film_m : float, optional
        Film at which solids begin to bear: surfaces touch where the smallest film is below.

    Returns
    -------
    Deformed
        Result, statistics, spectra and warnings.

    Raises
    ------
    SurfaceError
        If the surface cannot be used, or its step is too coarse for the contact.

    Examples
    --------
    >>> import numpy as np
    >>> import ehlwave
    >>> contact = ehlwave.Contact(radius_x_m=0.0127, radius_y_m=0.0127, reduced_modulus_pa=2.26e11,
    ...     load_n=40, mean_speed_m_per_s=4, viscosity_pa_s=0.05)
    >>> x = np.arange(0, 2e-3, 2e-6)
    >>> height = 50e-9 * np.cos(2 * np.pi * x / 1e-4)
    >>> trace = ehlwave.surface.trace_surface(height, step_m=2e-6, axis="x", name="waves")
    >>> found = ehlwave.deform_surface(trace, contact.conditions, contact.transfer("recommended"))
    >>> found.height.shape == trace.height.shape
    True
    """
    chosen = transfer or transfer_for(Asked(conditions), "paper")
    checked_surface(surface)
    _check_scale(surface, conditions)
    flat = remove_form(surface, form)
    cutoffs_m = _checked_cutoffs(cutoffs_m)
    if cutoffs_m != (None, None):
        flat = gaussian_filtered(flat, *cutoffs_m)
    working = flat.height
    if working.size > SINGLE_PRECISION_POINTS:
        working = working.astype(np.float32, copy=False)
    shape = flat.height.shape
    height, spectra, cover, rise = superposed(working, flat, conditions, chosen, window)
    part = judged_part((shape[0], shape[1]), window)
    error_m = cover.error_m()
    before_m = math.sqrt(cover.total.before)
    error = error_m / before_m if error_m is not None and before_m > 0 else error_m
    known = Components(rise, error)
    if boundary_film_m is not None and not number(boundary_film_m, "boundary_film_m") > 0:
        raise SurfaceError(f"boundary_film_m = {boundary_film_m}: give a film above 0, in m")
    statistics = film_statistics(
        flat.height[part], height[part], conditions, known, boundary_film_m
    )
    is_for_rolling = isinstance(chosen, FormulaBasis)
    return Deformed(
        surface=flat,
        height=height,
        conditions=conditions,
        transfer_name=chosen.name,
        form=form,
        window=window,
        spectra=spectra,
        statistics=statistics,
        unjudged=cover.unjudged(),
        warnings=warnings_of(statistics, conditions, is_for_rolling),
        error_m=error_m,
        cutoffs_m=cutoffs_m,
        transfer=chosen,
        bands=cover.bands.gradients(statistics),
    )


def _checked_cutoffs(cutoffs_m: Any) -> Cutoffs:  # noqa: ANN401 - user input
    """Return both cut-offs, m; SurfaceError if they are no pair of numbers or None."""
    try:
        long, short = plain(cutoffs_m, "cutoffs_m")
    except (TypeError, ValueError):
        raise SurfaceError(
            f"cutoffs_m = {cutoffs_m!r}: give both, (lambda_c, lambda_s), such as (80e-6, None)"
        ) from None
    found = [None if one is None else number(one, "cutoffs_m") for one in (long, short)]
    return found[0], found[1]


def _check_scale(surface: Surface, conditions: Conditions) -> None:
    """Refuse surfaces whose lengths, or directions, cannot belong to the contact."""
    if conditions.is_line and surface.height.shape[1] > 1:
        raise SurfaceError(f"{surface.name}: {TRANSVERSE_ALONE}")
    lengths = (
        ("x", surface.height.shape[0], surface.step_x_m, conditions.semi_axis_a_m, "a"),
        ("y", surface.height.shape[1], surface.step_y_m, conditions.semi_axis_b_m, "b"),
    )
    for letter, count, step, axis, name in lengths:
        if count == 1:
            continue
        if step > axis:
            raise SurfaceError(
                f"{surface.name}: the step along {letter} is {step * 1e6:.4g} um, more than the "
                f"contact's semi-axis {name} = {axis * 1e6:.4g} um: no component inside the "
                "contact is resolved. Is length_unit= right?"
            )
        if count * step < 0.1 * axis:
            raise SurfaceError(
                f"{surface.name}: the surface is {count * step * 1e6:.4g} um long along {letter}, "
                f"less than a tenth of the contact's semi-axis {name} = {axis * 1e6:.4g} um. "
                "Is length_unit= right?"
            )
