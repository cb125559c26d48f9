"""Oils from data sheets: input of contacts at a given temperature."""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ehlwave.choices import chosen
from ehlwave.contact.alpha_estimates import State
from ehlwave.contact.data_errors import EYRING_ERROR, OIL_ERRORS
from ehlwave.contact.measured_oils import DENSITY_15C, MEASURED, SOURCE, TEMPERATURES_K
from ehlwave.contact.oil_heat import own_heat, usual_heat
from ehlwave.contact.sheet_values import (
    PASSED,
    alpha_of,
    check_names,
    needed,
    positive,
    viscosity_error,
    viscosity_lines,
)
from ehlwave.contact.viscosity_grade import COLD_K, HOT_K, Walther
from ehlwave.errors import SurfaceError, see
from ehlwave.quantities import ZERO_CELSIUS_K, number
from ehlwave.shown import percent

DENSITY_K = 288.15
"""15 C, where data sheets state densities."""

DENSITIES = {"mineral": 880.0, "pao": 835.0, "ester": 920.0, "polyglycol": 1050.0}
"""Usual densities at 15 C by the kind of base oil, kg/m3; a film changes by 0.7 % for 1 %."""

EXPANSION_PER_K = 7e-4
"""Usual of oils, 1/K, relative to 15 C."""

_STEP_K = 0.01


@dataclass(frozen=True)
class Oil:
    """An oil at a given temperature, for :meth:`ehlwave.Contact.from_bodies`.

    Make it by :meth:`from_grade` or :meth:`named`, or from its own numbers.

    Parameters
    ----------
    viscosity_pa_s : float
        At ambient pressure, Pa s.
    pressure_viscosity_per_pa : float
        alpha, 1/Pa.
    temperature_k : float, optional
        Where these are so, K.
    viscosity_error, pressure_viscosity_error : float
        Relative; films include their effect.
    roelands_index : float
        z of Roelands' law.
    density_kg_per_m3 : float, optional
        At this temperature.
    viscosity_temperature_per_k : float, optional
        beta = -d ln eta/dT at ambient pressure, 1/K.
    eyring_stress_pa : float, optional
        Of a Ree-Eyring oil, which contacts that slide need.
    eyring_stress_error : float
        Relative; friction includes its effect.
    conductivity_w_per_m_k, heat_capacity_j_per_kg_k : float, optional
        At this temperature, for films and friction with heat.
    conductivity_error : float
        Relative; films and friction with heat carry it.
    source : str
        Source of the numbers.

    Examples
    --------
    >>> import ehlwave
    >>> oil = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=333.15)
    >>> print(oil)
    24.2 mPa s within 10 % and alpha = 17.8 1/GPa within 31 % at 60 C
    """

    viscosity_pa_s: float
    pressure_viscosity_per_pa: float
    temperature_k: float | None = None
    viscosity_error: float = 0.0
    pressure_viscosity_error: float = 0.0
    roelands_index: float = 0.68
    density_kg_per_m3: float | None = None
    viscosity_temperature_per_k: float | None = None
    eyring_stress_pa: float | None = None
    eyring_stress_error: float = 0.0
    conductivity_w_per_m_k: float | None = None
    heat_capacity_j_per_kg_k: float | None = None
    conductivity_error: float = 0.0
    source: str = "given"

    def __post_init__(self) -> None:
        """Check and convert."""
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name != "source" and value is not None:
                found = number(value, field.name, "Oil")
                is_error = field.name.endswith("_error")
                if found < 0 or (found == 0 and not is_error):
                    least = "at least" if is_error else "above"
                    raise SurfaceError(f"Oil: {field.name} = {value} must be {least} 0")
                object.__setattr__(self, field.name, found)

    def __str__(self) -> str:
        """Return viscosity and alpha."""
        error = self.pressure_viscosity_error
        text = (
            f"{1e3 * self.viscosity_pa_s:.3g} mPa s{_within(self.viscosity_error)} and alpha = "
            f"{1e9 * self.pressure_viscosity_per_pa:.1f} 1/GPa{_within(error)}"
        )
        return text + (
            f" at {self.temperature_k - ZERO_CELSIUS_K:g} C" if self.temperature_k else ""
        )

    def keys(self) -> dict[str, float]:
        """Return the keys of a contact that the oil gives.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.Oil(viscosity_pa_s=0.05, pressure_viscosity_per_pa=2e-8).keys()
        {'viscosity_pa_s': 0.05, 'pressure_viscosity_per_pa': 2e-08, 'roelands_index': 0.68}
        """
        names = ["viscosity_pa_s", "pressure_viscosity_per_pa", "roelands_index"]
        names += ["eyring_stress_pa"] if self.eyring_stress_pa is not None else []
        errors = (*OIL_ERRORS, EYRING_ERROR)
        names += [name for name in errors if getattr(self, name) > 0]
        return {name: getattr(self, name) for name in names}

    @classmethod
    def from_grade(cls, **sheet: Any) -> "Oil":  # noqa: ANN401 - the names below
        """Return the oil of a data sheet at a temperature.

        Parameters
        ----------
        **sheet
            ``temperature_k``. The viscosity at 40 C: ``iso_vg`` (within 10 %, ISO 3448) or
            ``viscosity_40c_mm2_per_s``. Its change with temperature:
            ``viscosity_100c_mm2_per_s`` or ``viscosity_index`` (ASTM D2270; if both are left out
            the usual index of the kind, :data:`ehlwave.contact.sheet_values.USUAL_INDICES`, and the
            error covers the low and high index); between them ASTM D341 holds, and below 40 and
            above 100 C it is extrapolated, which the error includes. ``density_15c_kg_per_m3``
            (usual of the kind if left out). ``kind``: ``"mineral"`` (default), ``"pao"``,
            ``"ester"``, ``"polyglycol"``. ``pressure_viscosity_per_pa`` at this temperature with
            ``pressure_viscosity_error``, or
            ``alpha``, an estimate: ``"gold"`` (default), ``"wooster"``, ``"so-klaus"``; its scatter
            becomes the error. ``roelands_index``, ``eyring_stress_pa``,
            ``eyring_stress_error``. Conductivity and heat capacity are usual ones of the
            kind (:mod:`ehlwave.contact.oil_heat`) unless
            ``conductivity_w_per_m_k`` and ``heat_capacity_j_per_kg_k`` are given.

        Raises
        ------
        SurfaceError
            If a name is unknown, missing or contradicts another, or no oil has such numbers.

        Examples
        --------
        >>> import ehlwave
        >>> oil = ehlwave.Oil.from_grade(viscosity_40c_mm2_per_s=46, viscosity_100c_mm2_per_s=7.9,
        ...     kind="pao", temperature_k=343.15)
        >>> print(oil)
        13.2 mPa s and alpha = 12.1 1/GPa within 31 % at 70 C
        """
        check_names(sheet)
        kind = chosen(sheet.get("kind", "mineral"), "kind", DENSITIES, "Oil", see("oil"))
        temperature = needed(sheet, "temperature_k")
        walther, others, said = viscosity_lines(sheet, kind)
        density_15c = sheet.get("density_15c_kg_per_m3", DENSITIES[kind])
        density_15c = positive(density_15c, "density_15c_kg_per_m3")

        def density(at_k: float) -> float:
            return density_15c / (1 + EXPANSION_PER_K * (at_k - DENSITY_K))

        def viscosity(at_k: float) -> float:
            return 1e-6 * walther.viscosity(at_k) * density(at_k)

        state = State(walther.viscosity(temperature), density(temperature), walther, kind)
        alpha, scatter, source = alpha_of(sheet, state)
        step = _STEP_K
        log_slope = np.log(viscosity(temperature - step) / viscosity(temperature + step))
        passed = {key: sheet[key] for key in PASSED if key in sheet}
        usual = own_heat(usual_heat(kind, temperature, density_15c), passed)
        extrapolated = "" if COLD_K <= temperature <= HOT_K else " extrapolated"
        return cls(
            viscosity_pa_s=viscosity(temperature),
            pressure_viscosity_per_pa=alpha,
            temperature_k=temperature,
            viscosity_error=viscosity_error(walther, others, temperature, "iso_vg" in sheet),
            pressure_viscosity_error=scatter,
            density_kg_per_m3=state.density_kg_per_m3,
            viscosity_temperature_per_k=float(log_slope / (2 * step)),
            source=f"{said}, ASTM D341{extrapolated}; alpha: {source}",
            **usual,
        )

    @classmethod
    def named(cls, name: str, temperature_k: Any, **others: Any) -> "Oil":  # noqa: ANN401
        """Return a measured oil by its name, between 30 and 100 C.

        Between measured temperatures viscosity follows ASTM D341, alpha a straight line over T. The
        source states no errors; none is included. It has no conductivities and heat capacities:
        usual values of mineral oils replace them.

        Parameters
        ----------
        name : str
            Of :data:`ehlwave.contact.measured_oils.MEASURED`.
        temperature_k : float
            Temperature, K.
        **others
            ``roelands_index``, ``eyring_stress_pa``, ``eyring_stress_error``,
            ``conductivity_w_per_m_k``, ``heat_capacity_j_per_kg_k``.

        Examples
        --------
        >>> import ehlwave
        >>> print(ehlwave.Oil.named("heavy machine oil 153", temperature_k=333.15))
        34 mPa s and alpha = 20.5 1/GPa at 60 C
        """
        chosen(name, "name", MEASURED, "Oil", see("oil"))
        temperature = number(temperature_k, "temperature_k", "Oil")
        alphas = MEASURED[name].alpha_per_gpa
        known = [i for i, alpha in enumerate(alphas) if alpha is not None]
        low, high = TEMPERATURES_K[known[0]], TEMPERATURES_K[-1]
        if not low <= temperature <= high:
            raise SurfaceError(
                f"Oil: temperature_k = {temperature:g}: {name} was measured from {low:g} to "
                f"{high:g} K"
            )
        i = 0 if temperature < TEMPERATURES_K[1] else 1
        points = [
            (t, 1e3 * eta / _usual_density(t))
            for t, eta in zip(TEMPERATURES_K, MEASURED[name].viscosity_mpa_s, strict=True)
        ]
        line = Walther.through(points[i], points[i + 1])

        def viscosity(at_k: float) -> float:
            return 1e-6 * line.viscosity(at_k) * _usual_density(at_k)

        step = _STEP_K
        slope = np.log(viscosity(temperature - step) / viscosity(temperature + step)) / (2 * step)
        measured = [alphas[k] for k in known]
        return cls(
            viscosity_pa_s=viscosity(temperature),
            pressure_viscosity_per_pa=1e-9
            * float(np.interp(temperature, [TEMPERATURES_K[k] for k in known], measured)),
            temperature_k=temperature,
            density_kg_per_m3=_usual_density(temperature),
            viscosity_temperature_per_k=float(slope),
            source=f"{name}: {SOURCE}",
            **own_heat(usual_heat("mineral", temperature, DENSITY_15C), others),
        )


def _usual_density(temperature_k: float) -> float:
    return DENSITY_15C / (1 + EXPANSION_PER_K * (temperature_k - DENSITY_K))


def _within(error: float) -> str:
    if error >= 1:
        return f" within a factor of {1 + error:.2g}"
    return f" within {percent(error)}" if error else ""
