"""The coordinates of contacts in which responses are smooth, and components of waves."""

from collections.abc import Iterable, Mapping

from numpy.typing import ArrayLike, NDArray

from ehlwave.contact.conditions import MOES_KEYS
from ehlwave.contact.oils import log_viscosity
from ehlwave.contact.scales import (
    alphabar,
    ellipticity,
    moes_film,
    moes_per_film,
    pressure_factor,
)
from ehlwave.duals import np, to_float
from ehlwave.laws.atlas.ranges import (
    CONTACT_RANGES,
    LARGEST_ALPHABAR,
    LARGEST_PRESSURE_PA,
    THICKEST_FILM,
    THINNEST_FILM,
)

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]


def contact_coordinates(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return the coordinates of contacts, shape (c, 5), by columns named as the input keys.

    H, the central film of Moes' formula over the Hertz approach c, represents M: the inlet is as
    long as H^(2/3) a, in contacts of any load. Its root changes most where responses do, at low
    loads. The viscosity of the oil under the Hertz pressure, eta0 exp(B), matters more than alpha,
    z and even L; the pressure represents the compressibility.
    """
    m, l, d, alpha, z = map(np.atleast_1d, columns(keys, CONTACT_RANGES))  # noqa: E741
    gamma = np.vectorize(lambda d: pressure_factor(ellipticity(d)), otypes=[float])(d)
    pressure = alphabar(m, l, gamma) / alpha
    b = log_viscosity(alpha, z, pressure)
    parts = np.sqrt(hertz_film(m, l, d)), np.log(l), np.log(d), np.log(pressure), np.log(b)
    return np.stack(parts, axis=1)


def beyond_limits(keys: Mapping[str, float]) -> str:
    """Return the excess of an elliptical contact over the atlas; '' if none."""
    m, l, d = (keys[key] for key in MOES_KEYS)  # noqa: E741
    film = to_float(hertz_film(m, l, d))
    if film > THICKEST_FILM * (1 + 1e-9):
        return (
            f"a film of {film:.3g} times the Hertz approach (of at most {THICKEST_FILM:g}: "
            "thicker films hardly deform the bodies)"
        )
    if film < THINNEST_FILM * (1 - 1e-9):
        return (
            f"a film of {film:.3g} times the Hertz approach (of at least {THINNEST_FILM:g}: "
            "thinner films have inlets too steep)"
        )
    product = alphabar(m, l, pressure_factor(ellipticity(d)))
    if product > LARGEST_ALPHABAR * (1 + 1e-9):
        return f"alpha ph of {product:.3g} (of at most {LARGEST_ALPHABAR:g})"
    pressure = product / keys["pressure_viscosity_per_pa"]
    if pressure > LARGEST_PRESSURE_PA * (1 + 1e-9):
        most = LARGEST_PRESSURE_PA / 1e9
        return f"a Hertz pressure of {pressure / 1e9:.3g} GPa (of at most {most:g})"
    return ""


def rolling_references(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return the central film of Moes' formula, Moes scale, for both films, shape (c, 2)."""
    rows = zip(*map(np.atleast_1d, columns(keys, MOES_KEYS)), strict=True)
    return np.array([2 * (moes_film(*row),) for row in rows])


def columns(keys: Mapping[str, ArrayLike], names: Iterable[str]) -> list[Floats]:
    """Return some columns as arrays."""
    return [np.asarray(keys[name], dtype=float) for name in names]


def hertz_film(m: ArrayLike, l: ArrayLike, d: ArrayLike) -> Floats:  # noqa: E741
    """Return the central film of Moes' formula over the Hertz approach c."""

    def film(m: float, l: float, d: float) -> float:  # noqa: E741
        return moes_film(m, l, d) / moes_per_film(m, ellipticity(d))

    return np.asarray(np.vectorize(film, otypes=[float])(m, l, d))


def wave_components(wavelength: ArrayLike, angle_deg: ArrayLike) -> tuple[Floats, Floats]:
    """Return wavelengths along X and Y, 0 for infinite, of waves of this length and direction."""
    wave, theta = np.broadcast_arrays(np.asarray(wavelength, float), np.radians(angle_deg))
    parts = []
    for share in (np.abs(np.cos(theta)), np.abs(np.sin(theta))):
        with np.errstate(divide="ignore"):
            parts.append(np.where(share > 1e-9, wave / share, 0.0))
    return parts[0], parts[1]
