"""Responses of a contact to many waves, as a labelled dataset and a figure."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.starvation import is_fitted
from ehlwave.errors import SurfaceError
from ehlwave.extras import load
from ehlwave.laws.atlas.ranges import WAVE_RANGE
from ehlwave.quantities import plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DEFAULT_WAVES = np.geomspace(*WAVE_RANGE, 41)
DEFAULT_ANGLES = (0.0, 45.0, 90.0)

VARIABLES = {
    "film_real": ("1", "real part of the film over Ai"),
    "film_imag": ("1", "imaginary part of the film over Ai, positive where it lags"),
    "film_amplitude": ("1", "amplitude of the film over Ai"),
    "film_phase": ("rad", "lag of the film behind the surface"),
    "film_error": ("1", "absolute error of the film over Ai, 95 % of responses"),
    "pressure_real": ("1", "real part of the pressure over Ai, in units of ph/c"),
    "pressure_imag": ("1", "imaginary part of the pressure over Ai, in units of ph/c"),
}
"""Units and long names."""


WITHOUT_PHASE = ("film_amplitude", "film_error")
"""Columns of starved contacts, whose law has no phase and no pressure."""


class OneResponse(Protocol):
    """A response, as :class:`ehlwave.Response`."""

    @property
    def film(self) -> complex:
        """Film over Ai."""

    @property
    def pressure(self) -> complex:
        """Pressure over Ai."""

    @property
    def error(self) -> float:
        """Response of the film."""

    @property
    def source(self) -> str:
        """Source."""


def response_table(
    respond: Callable[..., OneResponse],
    conditions: Conditions,
    wavelength_over_a: ArrayLike | None,
    angle_deg: ArrayLike | None,
    slip_parameter: float | None,
) -> xr.Dataset:
    """Return the responses over wavelength and angle; waves outside the range are NaN.

    `respond` answers for a wave, :meth:`ehlwave.Contact.response`.
    """
    angles_of_all = (0.0,) if conditions.is_line else DEFAULT_ANGLES
    waves = DEFAULT_WAVES if wavelength_over_a is None else wavelength_over_a
    wave = _column(waves, "wavelength_over_a")
    angle = _column(angles_of_all if angle_deg is None else angle_deg, "angle_deg")
    inside = _is_inside(wave[:, None], angle[None, :], conditions.is_line)
    if conditions.is_starved:
        inside &= is_fitted(wave[:, None], angle[None, :])
    values = {name: np.full(inside.shape, np.nan) for name in VARIABLES}
    sources: set[str] = set()
    for place in zip(*np.nonzero(inside), strict=True):
        found = respond(float(wave[place[0]]), float(angle[place[1]]), slip_parameter)
        sources.add(found.source)
        numbers = {
            "film_real": found.film.real,
            "film_imag": found.film.imag,
            "film_amplitude": abs(found.film),
            "film_phase": float(np.angle(found.film)),
            "film_error": found.error,
            "pressure_real": found.pressure.real,
            "pressure_imag": found.pressure.imag,
        }
        for name, number in numbers.items():
            is_known = not conditions.is_starved or name in WITHOUT_PHASE
            values[name][place] = number if is_known else np.nan
    return _labelled(wave, angle, inside, values).assign_attrs(
        load_parameter_m=conditions.m,
        lubricant_parameter_l=conditions.l,
        radius_ratio_d=conditions.d,
        slip_parameter=conditions.slip_parameter if slip_parameter is None else slip_parameter,
        semi_axis_a_m=conditions.semi_axis_a_m,
        source="; ".join(sorted(sources)),
        surface="A exp(i(kx X - w T)), positive where it widens the gap",
    )


def _labelled(
    wave: NDArray[Any], angle: NDArray[Any], inside: NDArray[Any], values: dict[str, NDArray[Any]]
) -> xr.Dataset:
    dims = ("wavelength", "angle")
    variables = {
        name: (dims, values[name], {"units": unit, "long_name": text})
        for name, (unit, text) in VARIABLES.items()
    }
    variables["is_inside"] = (
        dims,
        inside,
        {"long_name": "whether the wave lies in the range that was computed"},
    )
    coordinates = {
        "wavelength": (
            "wavelength",
            wave,
            {"units": "1", "long_name": "wavelength along the wave vector over a"},
        ),
        "angle": (
            "angle",
            angle,
            {"units": "degree", "long_name": "between wave vector and rolling direction"},
        ),
    }
    return xr.Dataset(variables, coords=coordinates)


def _column(values: ArrayLike, name: str) -> NDArray[np.float64]:
    found = plain(values, name)
    try:
        if any(isinstance(one, (bool, np.bool_)) for one in np.asarray(found, object).ravel()):
            raise TypeError
        return np.atleast_1d(np.asarray(found, dtype=np.float64)).ravel()
    except (TypeError, ValueError):
        raise SurfaceError(f"{name} = {values!r}: give numbers") from None


def _is_inside(wave: NDArray[Any], angle: NDArray[Any], is_line: bool) -> NDArray[np.bool_]:
    low, high = WAVE_RANGE
    last = 0 if is_line else 90
    is_wave = (wave >= low * (1 - 1e-9)) & (wave <= high * (1 + 1e-9))
    return np.asarray(is_wave & (angle >= -1e-9) & (angle <= last + 1e-9))


def responses_figure(responses: xr.Dataset) -> "Figure":
    """Draw amplitude and phase against wavelength, a curve an angle; bands are errors.

    Parameters
    ----------
    responses : xarray.Dataset
        From :meth:`ehlwave.Contact.responses`.
    """
    colours = load("ehlwave.results.figures").COLOURS
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 2.9), layout="constrained")
    amplitude, phase = figure.subplots(1, 2, sharex=True)
    wave = responses["wavelength"].values
    for index, angle in enumerate(responses["angle"].values):
        one = responses.isel(angle=index)
        colour = colours[index % len(colours)]
        size, error = one["film_amplitude"].values, one["film_error"].values
        lag, lag_error = np.degrees(one["film_phase"].values), _phase_error(size, error)
        label = rf"{angle:g}$^\circ$"
        for axes, middle, bar in ((amplitude, size, error), (phase, lag, lag_error)):
            axes.fill_between(wave, middle - bar, middle + bar, color=colour, alpha=0.25, lw=0)
            axes.plot(wave, middle, color=colour, label=label)
    for axes in (amplitude, phase):
        axes.set(xscale="log", xlabel=r"wavelength $\lambda/a$")
    amplitude.set(ylabel=r"film amplitude $A_d/A_i$", ylim=(0, None))
    phase.set(ylabel="lag of the film [degrees]")
    amplitude.legend(title="wave vector", frameon=False, fontsize=8, title_fontsize=8)
    return figure


def _phase_error(size: NDArray[Any], error: NDArray[Any]) -> NDArray[Any]:
    """Return by how much the phase may be off, in degrees; all of it where error is above size."""
    return np.degrees(np.arcsin(np.clip(error / size, 0, 1)))
