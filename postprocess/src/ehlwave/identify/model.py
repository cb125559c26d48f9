"""Results of a contact and their derivatives by keys, of the laws or of the program."""

import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlwave.contact.conditions_read import given_of
from ehlwave.duals import Dual, math, seeded, to_float
from ehlwave.errors import (
    ArgumentError,
    ExtrapolationWarning,
    ProgramError,
    RangeError,
    ResultsError,
)
from ehlwave.identify.measurements import TEMPERATURE
from ehlwave.inputs.key_classes import HEAT_DATA
from ehlwave.inputs.key_table import KEYS
from ehlwave.operating_point import contact_of
from ehlwave.operating_point.gradients import computed

Keys = Mapping[str, Any]

VISCOSITY, DECAY = "viscosity_pa_s", "viscosity_temperature_per_k"
WAVES = ("wavelength_over_a", "orientation")
NOT_OF_LAWS = ("cells_x", "cells_y", "accuracy", "sensitivities", "tolerance", *WAVES)
USABLE = ("converged", "unresolved", "inaccurate")


def at_temperature(keys: Keys, reference_k: float | None) -> dict[str, Any]:
    """Return keys with the viscosity at their temperature, as cases without heat take it."""
    found = dict(keys)
    if any(key in found for key in HEAT_DATA if key != DECAY):
        return found
    decay, temperature = found.pop(DECAY, 0.0), found.get(TEMPERATURE)
    if str(found.get("viscosity_law", "")).lower() != "table":
        found.pop(TEMPERATURE, None)
    if temperature is not None and reference_k is not None:
        found[VISCOSITY] = found[VISCOSITY] * math.exp(-decay * (temperature - reference_k))
    return found


def by_laws(keys: Keys, result: str) -> float:
    """Return the logarithm of a result by the laws; raises RangeError where none holds."""
    given = {key: value for key, value in keys.items() if key not in NOT_OF_LAWS}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ExtrapolationWarning)
        contact = contact_of(given_of(given, "conditions"))
        if result == "harmonic_ratio":
            angle = 90.0 if str(keys.get("orientation")) == "longitudinal" else 0.0
            response = contact.response(to_float(keys["wavelength_over_a"]), angle, by="laws")
            return math.log(abs(response.film))
        film = contact.film("laws")
    found = {
        "central_film_m": film.central_m,
        "minimum_film_m": film.minimum_m,
        "friction_coefficient": film.friction,
    }[result]
    if not found:
        raise RangeError(f"no law has {result} of this contact")
    return math.log(abs(found))


def by_program(
    keys: Keys, result: str, refusal: RangeError | None = None
) -> tuple[float, dict[str, float]]:
    """Return the logarithm of a result of ``ehlwave-case``, and its derivatives by keys."""
    given = dict(keys)
    if "wavelength_over_a" in keys:
        given |= {"orientation": keys.get("orientation", "transverse"), "response": "harmonic"}
    flow = {"eyring_stress_pa": "eyring", "carreau_modulus_pa": "carreau"}
    for key, law in flow.items():
        if key in given:
            given.setdefault("flow_law", law)
    found = computed(given, refusal)
    name, scale = (
        (result.removesuffix("_m") + "_um", 1e-6) if result.endswith("_m") else (result, 1)
    )
    if found["status"] not in USABLE or not found.get(name):
        raise ProgramError(
            f"{result} is not known of a contact ({found['status']}): {found['message']}"
            f"{found.get('warning') or ''}"
        )
    start = f"sensitivity_{result.removesuffix('_m')}_"
    slopes = {key.removeprefix(start): v for key, v in found.items() if key.startswith(start)}
    return math.log(abs(found[name]) * scale), {k: v for k, v in slopes.items() if v is not None}


class Model:
    """Logarithms of the results of all rows, and their derivatives by the logarithms of parameters.

    Parameters
    ----------
    rows : sequence of mapping
        Keys of each row, with the parameters' first values.
    results : sequence of str
        Name of each row's result.
    parameters : sequence of str
        Keys that are fitted.
    reference_k : float, optional
        Temperature at which ``viscosity_pa_s`` is given, where temperatures vary.
    by : {"laws", "computed"}, optional
        As of :meth:`ehlwave.Contact.film`.
    """

    def __init__(
        self,
        rows: Sequence[Keys],
        results: Sequence[str],
        parameters: Sequence[str],
        reference_k: float | None = None,
        by: str | None = None,
    ) -> None:
        self.rows, self.results = list(rows), list(results)
        self.parameters, self.reference_k, self.by = list(parameters), reference_k, by
        self.sources: set[str] = set()
        self._is_started = False
        self._refusals: dict[int, RangeError] = {}
        """Rows that the program answers for: those that no law had where the fit began."""

    def __call__(self, values: NDArray[np.float64]) -> tuple[NDArray[np.float64], Any]:
        """Return ln(results) and their Jacobian at logarithms of the parameters."""
        chosen = dict(zip(self.parameters, np.exp(values), strict=True))
        both = []
        for k, name in enumerate(self.results):
            try:
                both.append(self._row(k, chosen))
            except ResultsError as problem:
                raise ArgumentError(f"measured value {k + 1}, {name}: {problem}") from problem
        self._is_started = True
        return np.array([one for one, _ in both]), np.array([slope for _, slope in both])

    def _row(self, k: int, chosen: dict[str, float]) -> tuple[float, list[float]]:
        keys, refusal = {**self.rows[k], **chosen}, self._refusals.get(k)
        if self.by != "computed" and not refusal:
            try:
                return self._laws(keys, self.results[k])
            except RangeError as error:
                if self.by == "laws" or self._is_started:
                    raise
                refusal = self._refusals[k] = error
        self.sources.add("ehlwave-case")
        here = at_temperature(keys, self.reference_k)
        value, slopes = by_program(here, self.results[k], refusal)
        rise = keys.get(TEMPERATURE, 0.0) - (self.reference_k or keys.get(TEMPERATURE, 0.0))
        slopes[DECAY] = -slopes.get(VISCOSITY, 0.0) * rise * chosen.get(DECAY, 0.0)
        return value, [slopes.get(key, 0.0) for key in self.parameters]

    def _laws(self, keys: Keys, result: str) -> tuple[float, list[float]]:
        middle = by_laws(at_temperature(keys, self.reference_k), result)
        seeds = seeded({key: keys[key] for key in self.parameters})
        found: Any = by_laws(at_temperature({**keys, **seeds}, self.reference_k), result)
        self.sources.add("laws")
        return middle, found.slopes.tolist() if isinstance(found, Dual) else [0.0] * len(seeds)


def check_parameter(key: str, words: Mapping[str, str]) -> str:
    """Return the key of a parameter's name."""
    key = words.get(key, key)
    if key not in KEYS or KEYS[key].kind != "number":
        raise ArgumentError(
            f"--fit {key}: no such parameter: give {', '.join(words)}, or a key of &lubricant or "
            "&conditions"
        )
    return key
