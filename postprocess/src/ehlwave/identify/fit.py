"""Least squares: the parameters of an oil that measured values imply, with their uncertainty."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ehlwave.errors import ArgumentError
from ehlwave.identify.identified import Identified, result_of
from ehlwave.identify.measurements import TEMPERATURE, Measurements, read_measurements
from ehlwave.identify.model import DECAY, VISCOSITY, Model, check_parameter
from ehlwave.inputs.key_table import KEYS
from ehlwave.inputs.slip import RATIO, SLIP, merged
from ehlwave.traction.given import read_keys

if TYPE_CHECKING:
    import pandas as pd

PARAMETERS = {
    "alpha": "pressure_viscosity_per_pa",
    "viscosity": VISCOSITY,
    "eyring_stress": "eyring_stress_pa",
    "carreau_modulus": "carreau_modulus_pa",
    "viscosity_temperature": DECAY,
    "roelands": "roelands_index",
    "modulus": "reduced_modulus_pa",
}
"""Short names of parameters."""

FIRST = {
    "pressure_viscosity_per_pa": 2e-8,
    "eyring_stress_pa": 5e6,
    "roelands_index": 0.68,
    DECAY: 0.04,
}
"""Values from which a fit begins where the conditions have none."""


MOST_REFUSED = {False: 60, True: 5}
"""Steps of a fit that may lead to contacts without an answer, by laws and where one is computed."""
NEAR, STATIONARY = 1e-3, 1e-4
"""Distance in logarithms from such a step, and cosine between residuals and derivatives, by which
a fit ends at the edge of the range and not at a minimum."""


def identify(
    measurements: "Measurements | str | Path | pd.DataFrame",
    conditions: "dict[str, Any] | str | Path",
    fit: Sequence[str],
    error: float | None = None,
    by: str | None = None,
) -> Identified:
    """Fit parameters of a contact to measured films, frictions or amplitude ratios.

    Least squares of ln(measured/computed) over the standard errors, with derivatives from the laws
    or from ``ehlwave-case``.

    Parameters
    ----------
    measurements : Measurements, path or DataFrame
        See :func:`read_measurements`.
    conditions : dict or path
        Keys of the contact, or an input file of ``ehlwave-case``; the fit begins there.
    fit : sequence of str
        ``"alpha"``, ``"viscosity"``, ``"eyring_stress"``, ``"viscosity_temperature"`` or other
        keys with a number. Where temperatures vary, the viscosity is that at ``temperature_k`` of
        the conditions, and falls as exp(-viscosity_temperature (T - T0)).
    error : float, optional
        Relative standard error of values without a column of their own; absent: by the residuals.
    by : {"laws", "computed"}, optional
        As of :meth:`ehlwave.Contact.film`.

    Raises
    ------
    ArgumentError
        If something is missing, there are fewer values than parameters, a measured contact has no
        derivatives (computed contacts with heat have none), or the fit ends where no law and no
        program answers.

    Examples
    --------
    >>> import pandas as pd
    >>> from ehlwave.identify import identify
    >>> rig = pd.DataFrame({"mean_speed_m_per_s": [0.5, 1, 2],
    ...     "central_film_um": [0.213, 0.338, 0.535]})
    >>> ball = {"radius_x_m": 0.0127, "radius_y_m": 0.0127, "reduced_modulus_pa": 2.26e11,
    ...     "load_n": 40, "viscosity_pa_s": 0.05}
    >>> found = identify(rig, ball, ["alpha"], by="laws")
    >>> [parameter.name for parameter in found.parameters]
    ['pressure_viscosity_per_pa']
    """
    from scipy.optimize import least_squares

    data = measurements
    if not isinstance(data, Measurements):
        data = read_measurements(data)
    keys = dict(conditions) if isinstance(conditions, dict) else read_keys(conditions)
    names = [check_parameter(word, PARAMETERS) for word in fit]
    _check(data, names)
    start, reference = _start(keys, names, data)
    rows = [merged({**keys, **start}, row) for row in data.conditions]
    if clash := [name for name in names if any(name in row for row in data.conditions)]:
        raise ArgumentError(f"--fit {clash[0]}: the measurements have a column of it")
    for number, (row, name) in enumerate(zip(rows, data.result, strict=True), 1):
        if name == "harmonic_ratio" and "wavelength_over_a" not in row:
            raise ArgumentError(f"measured value {number}, {name}: give its wavelength_over_a")
        if name == "friction_coefficient" and not row.get(RATIO) and row.get(SLIP, 1) == 1:
            raise ArgumentError(
                f"measured value {number}, {name}: a contact that rolls has none: give a "
                "slide_to_roll_ratio above 0, or leave the value out"
            )
    model = Model(rows, data.result, names, reference, by)
    weights = 1 / _errors(data, error)
    measured = np.log(data.value)
    known: dict[bytes, Any] = {}
    refused: list[tuple[NDArray[np.float64], ArgumentError]] = []

    def at(values: NDArray[np.float64]) -> Any:  # noqa: ANN401
        place = values.tobytes()
        if place not in known:
            try:
                known[place] = model(values)
            except ArgumentError as problem:
                if not known or len(refused) == MOST_REFUSED["ehlwave-case" in model.sources]:
                    raise
                refused.append((values.copy(), problem))
                known[place] = np.full(len(data), np.inf), None  # the fit takes a shorter step
        return known[place]

    first = np.log([start[name] for name in names])
    found = least_squares(
        lambda x: weights * (at(x)[0] - measured),
        first,
        jac=lambda x: weights[:, None] * at(x)[1],
        bounds=_bounds(names, first),
        x_scale=1.0,
        xtol=1e-8,
        ftol=1e-10,
        gtol=1e-10,
    )
    result = result_of(data, names, reference, found, at(found.x)[0], weights, error, model)
    _check_end(found, refused, result)
    return result


def _check_end(
    found: Any,  # noqa: ANN401 - of least_squares
    refused: list[tuple[NDArray[np.float64], ArgumentError]],
    result: Identified,
) -> None:
    """Refuse a fit that ends where a measured contact leaves the range of its law."""
    size = np.linalg.norm(found.jac, axis=0) * np.linalg.norm(found.fun)
    is_smallest = np.all(np.abs(found.jac.T @ found.fun) <= STATIONARY * size)
    near = [problem for x, problem in refused if np.linalg.norm(x - found.x) < NEAR]
    if is_smallest or not near:
        return
    ends = ", ".join(f"{one.name} = {one.value:.4g}" for one in result.parameters)
    notes = "".join(f"; {note}" for note in result.notes)
    raise ArgumentError(
        f"the fit ends where contacts have no answer, at {ends}: {near[-1]}{notes}. Fit fewer "
        "parameters, or leave this value out"
    )


def _check(data: Measurements, names: list[str]) -> None:
    if len(set(names)) < len(names):
        raise ArgumentError(f"--fit {' '.join(names)}: a parameter is named twice")
    if len(data) < len(names):
        raise ArgumentError(
            f"{len(data)} measured values do not determine {len(names)} parameters: fit fewer"
        )


def _start(
    keys: dict[str, Any], names: list[str], data: Measurements
) -> tuple[dict[str, float], float | None]:
    """Return first values of the parameters, and the temperature of the viscosity."""
    start = {}
    for name in names:
        value = keys.get(name, FIRST.get(name))
        if value is None:
            raise ArgumentError(
                f"--fit {name}: the conditions have no {name}: give a value near it, where the fit "
                "begins"
            )
        start[name] = float(value)
    varying = [row[TEMPERATURE] for row in data.conditions if TEMPERATURE in row]
    if not varying:
        return start, None
    if DECAY not in names and DECAY not in keys and max(varying) > min(varying):
        raise ArgumentError(
            "the measurements have several temperatures: add viscosity_temperature to --fit, or "
            f"give {DECAY} in the conditions"
        )
    return start, float(keys.get(TEMPERATURE, np.mean(varying)))


def _errors(data: Measurements, error: float | None) -> NDArray[np.float64]:
    if error is not None and not 0 < error < 1:
        raise ArgumentError(f"error = {error:g}: give a relative standard error between 0 and 1")
    given = np.where(np.isfinite(data.error), data.error, 1.0 if error is None else error)
    if not ((given > 0) & (given <= 1)).all():
        raise ArgumentError(
            "a column of errors has values outside 0 to 1: give relative standard errors"
        )
    if np.isfinite(data.error).any() and not np.isfinite(data.error).all() and error is None:
        raise ArgumentError("some values have no error: give error, or fill the column")
    return given


def _bounds(names: list[str], first: NDArray[np.float64]) -> tuple[list[float], list[float]]:
    """Return the bounds of the keys, and at most a factor of 30 from the first value."""
    low, high = [], []
    for name, value in zip(names, first, strict=True):
        key = KEYS[name]
        least = max(getattr(key, "minimum", None) or 0.0, getattr(key, "above", None) or 0.0)
        most = getattr(key, "maximum", None) or np.inf
        low.append(max(np.log(least) if least > 0 else -np.inf, value - np.log(30)))
        high.append(min(np.log(most), value + np.log(30)))
    return low, high
