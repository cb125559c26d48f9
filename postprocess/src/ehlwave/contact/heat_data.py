"""Heat of a contact: thermal properties of oil and bodies, and the thermal thinning of the oil."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple

from ehlwave.duals import to_float
from ehlwave.errors import SurfaceError, see
from ehlwave.quantities import number


class BodyHeat(NamedTuple):
    """How a body conducts and stores heat; by default the soft steel of ``&heat``.

    Parameters
    ----------
    conductivity_w_per_m_k, density_kg_per_m3, heat_capacity_j_per_kg_k : float
        In W/(m K), kg/m3 and J/(kg K).

    Examples
    --------
    Hardened bearing steel:

    >>> import ehlwave
    >>> ehlwave.BodyHeat(conductivity_w_per_m_k=21).density_kg_per_m3
    7850.0
    """

    conductivity_w_per_m_k: float = 46.0
    density_kg_per_m3: float = 7850.0
    heat_capacity_j_per_kg_k: float = 470.0

    @property
    def effusivity(self) -> float:
        """Return (k rho c)^(1/2), W s^(1/2)/(m2 K): a fast surface is warmed by heat over it.

        Examples
        --------
        >>> import ehlwave
        >>> round(ehlwave.BodyHeat().effusivity)
        13028
        """
        conducted, density, capacity = self
        return to_float((conducted * density * capacity) ** 0.5)

    def peclet(self, speed_length: float) -> float:
        """Return u a rho c/(2 k), motion against conduction along it.

        Parameters
        ----------
        speed_length : float
            Speed times half-length of the contact along it, m2/s.

        Examples
        --------
        >>> import ehlwave
        >>> round(ehlwave.BodyHeat().peclet(2.0 * 1.9e-4), 1)
        15.2
        """
        conducted, density, capacity = self
        return speed_length * density * capacity / (2 * conducted)


SOFT_STEEL = BodyHeat()
CONDUCTIVITY_ERROR = "oil_conductivity_error"


@dataclass(frozen=True)
class Heat:
    """Thermal data of films and friction besides the contact: the keys of ``&heat``.

    Parameters
    ----------
    temperature_k : float
        T0, of the oil that enters and of both bodies, K.
    viscosity_temperature_per_k : float
        beta = -d ln eta/dT at ambient pressure and T0, 1/K.
    oil_conductivity_w_per_m_k, oil_heat_capacity_j_per_kg_k, oil_density_kg_per_m3 : float
        Of the oil.
    oil_expansion_per_k : float
        By which its density falls, 1/K.
    body, body2 : BodyHeat
        Of the first surface, which is rough, and of the second.
    oil_conductivity_error : float
        Relative; films and friction carry it. No key of ``&heat``.

    Raises
    ------
    SurfaceError
        If a number is none that a contact has.

    Examples
    --------
    >>> import ehlwave
    >>> heat = ehlwave.Heat(temperature_k=313.15, viscosity_temperature_per_k=0.045,
    ...     oil_conductivity_w_per_m_k=0.13, oil_heat_capacity_j_per_kg_k=1950,
    ...     oil_density_kg_per_m3=870)
    >>> heat.keys()["body_conductivity_w_per_m_k"]
    46.0
    """

    temperature_k: float
    viscosity_temperature_per_k: float
    oil_conductivity_w_per_m_k: float
    oil_heat_capacity_j_per_kg_k: float
    oil_density_kg_per_m3: float
    oil_expansion_per_k: float = 7e-4
    body: BodyHeat = SOFT_STEEL
    body2: BodyHeat | None = None
    oil_conductivity_error: float = 0.0

    def __post_init__(self) -> None:
        """Check and convert."""
        for field in fields(self):
            if field.name.startswith("body"):
                given = getattr(self, field.name)
                found = self.body if given is None else given
                if not isinstance(found, BodyHeat):
                    raise SurfaceError(f"Heat: {field.name} = {found!r} is no ehlwave.BodyHeat")
                for name, value in zip(BodyHeat._fields, found, strict=True):
                    _positive(value, f"{field.name}_{name}")
                object.__setattr__(self, field.name, BodyHeat(*map(to_float, found)))
                continue
            lowest = 0.0 if field.name in ("oil_expansion_per_k", CONDUCTIVITY_ERROR) else None
            value = _positive(getattr(self, field.name), field.name, lowest)
            object.__setattr__(self, field.name, value)
        if self.oil_conductivity_error >= 1:
            raise SurfaceError(
                f"Heat: {CONDUCTIVITY_ERROR} = {self.oil_conductivity_error:g} is relative: 0.1 is "
                "10 %; give 0 to 1"
            )
        if self.temperature_k <= 178:
            raise SurfaceError(
                f"Heat: temperature_k = {self.temperature_k:g} is in K: give 313.15 for 40 C"
            )

    @property
    def bodies(self) -> tuple[BodyHeat, BodyHeat]:
        """Return both bodies.

        Examples
        --------
        >>> import ehlwave
        >>> heat = ehlwave.Heat(313.15, 0.045, 0.13, 1950, 870)
        >>> heat.bodies[0] == heat.bodies[1] == ehlwave.BodyHeat()
        True
        """
        return self.body, self.body2 or self.body

    def exchanged(self) -> "Heat":
        """Return the data with the bodies exchanged.

        Examples
        --------
        >>> import ehlwave
        >>> glass = ehlwave.BodyHeat(1.1, 2500, 840)
        >>> heat = ehlwave.Heat(313.15, 0.045, 0.13, 1950, 870, body2=glass)
        >>> heat.exchanged().body == glass
        True
        """
        return replace(self, body=self.bodies[1], body2=self.bodies[0])

    def keys(self) -> dict[str, float]:
        """Return the keys of ``&heat``, and ``temperature_k``, for :class:`ehlwave.Case`.

        Examples
        --------
        >>> import ehlwave
        >>> ehlwave.Heat(313.15, 0.045, 0.13, 1950, 870).keys()["viscosity_temperature_per_k"]
        0.045
        """
        found = {
            field.name: getattr(self, field.name)
            for field in fields(self)
            if not field.name.startswith("body") and field.name != CONDUCTIVITY_ERROR
        }
        for name, body in zip(("body", "body2"), self.bodies, strict=True):
            found |= {f"{name}_{key}": value for key, value in body._asdict().items()}
        return found


def heat_of_keys(keys: Mapping[str, Any], place: str) -> Heat:
    """Return heat by keys of input files, with their defaults there.

    Raises SurfaceError if a value is missing or out of range.
    """
    names = [field.name for field in fields(Heat) if field.name != CONDUCTIVITY_ERROR]
    own = [name for name in names if not name.startswith("body")]
    given = {key: number(keys[key], key, place) for key in own if key in keys}
    given.setdefault("oil_expansion_per_k", 0.0)
    for key in own:
        if key not in given:
            raise SurfaceError(f"{place}: &heat needs {key}")

    def body_of(name: str, usual: BodyHeat) -> BodyHeat:
        own = {key: f"{name}_{key}" for key in BodyHeat._fields if f"{name}_{key}" in keys}
        return usual._replace(**{key: number(keys[one], one, place) for key, one in own.items()})

    body = body_of("body", SOFT_STEEL)
    values: Mapping[str, Any] = given
    return Heat(**values, body=body, body2=body_of("body2", body))


def heat_of(oil: Any, bodies: tuple[Any, Any]) -> Heat:  # noqa: ANN401 - Oil, Body: no circle
    """Return the heat of a contact by the own data of its oil and its bodies.

    Parameters
    ----------
    oil : Oil
        With temperature, density, conductivity and heat capacity.
    bodies : pair of Body
        Of known materials, or with numbers of their own.

    Raises
    ------
    SurfaceError
        If a value is unknown; the message names it.
    """
    if oil is None:
        raise SurfaceError(f"Contact: heat=True needs oil=ehlwave.Oil(...){see('oil')}")
    names: Mapping[str, str] = {
        "temperature_k": "temperature_k",
        "viscosity_temperature_per_k": "viscosity_temperature_per_k",
        "oil_conductivity_w_per_m_k": "conductivity_w_per_m_k",
        "oil_heat_capacity_j_per_kg_k": "heat_capacity_j_per_kg_k",
        "oil_density_kg_per_m3": "density_kg_per_m3",
    }
    values = {key: getattr(oil, name) for key, name in names.items()}
    missing = [names[key] for key, value in values.items() if value is None]
    if missing:
        raise SurfaceError(
            f"Contact: heat=True: the oil has no {missing[0]}, and no usual value is known of its "
            f"kind: give Oil(..., {missing[0]}=...), or heat=ehlwave.Heat(...){see('oil')}"
        )
    return Heat(
        **values,
        body=_body_heat(bodies[0], "body1"),
        body2=_body_heat(bodies[1], "body2"),
        oil_conductivity_error=oil.conductivity_error,
    )


def _body_heat(body: Any, name: str) -> BodyHeat:  # noqa: ANN401
    values = [getattr(body, key) for key in BodyHeat._fields]
    for key, value in zip(BodyHeat._fields, values, strict=True):
        if value is None:
            raise SurfaceError(
                f"Contact: heat=True: {name} has no {key}: give Body(..., {key}=...), a material, "
                f"or heat=ehlwave.Heat(...){see('bodies')}"
            )
    return BodyHeat(*values)


def _positive(value: Any, name: str, lowest: float | None = None) -> float:  # noqa: ANN401
    found = number(value, name, "Heat")
    if found < 0 or (found == 0 and lowest is None):
        raise SurfaceError(f"Heat: {name} = {value} must be above 0")
    return found
