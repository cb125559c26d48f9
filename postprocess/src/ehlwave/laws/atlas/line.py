"""The coordinates of line contacts, and their waves."""

from collections.abc import Mapping

from numpy.typing import ArrayLike

from ehlwave.contact.line_contact import (
    SLENDER_OVER_LINE,
    line_alphabar,
    line_film,
    moes_per_line_film,
)
from ehlwave.contact.oils import log_viscosity
from ehlwave.contact.rolling import transfer_along
from ehlwave.duals import np, to_float
from ehlwave.laws.atlas.coordinates import Floats, columns
from ehlwave.laws.atlas.ranges import LARGEST_LINE_ALPHABAR, LARGEST_PRESSURE_PA, LINE_RANGES
from ehlwave.laws.atlas.shape import INLET_SCALE, Seen, Shape, rolling_seen


def line_coordinates(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return the coordinates of line contacts, shape (c, 4), by columns named as the input keys.

    Coordinates as in elliptical contacts, without D: see ``atlas/coordinates.py``.
    """
    m, l, alpha, z = map(np.atleast_1d, columns(keys, LINE_RANGES))  # noqa: E741
    pressure = line_alphabar(m, l) / alpha
    b = log_viscosity(alpha, z, pressure)
    film = line_film(m, l) / moes_per_line_film(m)
    return np.stack([np.sqrt(film), np.log(l), np.log(pressure), np.log(b)], axis=1)


def beyond_line_limits(keys: Mapping[str, float]) -> str:
    """Return the excess of a line contact over the atlas; '' if none."""
    product = to_float(line_alphabar(*(keys[key] for key in list(LINE_RANGES)[:2])))
    if product > LARGEST_LINE_ALPHABAR * (1 + 1e-9):
        return f"alpha ph of {product:.3g} (of at most {LARGEST_LINE_ALPHABAR:g})"
    return ""


def beyond_sliding_limits(keys: Mapping[str, float]) -> str:
    """Return the excess of a sliding line contact, whose pressure is limited, too."""
    pressure = to_float(line_alphabar(*(keys[key] for key in list(LINE_RANGES)[:2])))
    pressure /= keys["pressure_viscosity_per_pa"]
    if pressure > LARGEST_PRESSURE_PA * (1 + 1e-9):
        most = LARGEST_PRESSURE_PA / 1e9
        return f"a Hertz pressure of {pressure / 1e9:.3g} GPa (of at most {most:g})"
    return beyond_line_limits(keys)


def line_references(keys: Mapping[str, ArrayLike]) -> Floats:
    """Return the film of Moes (1992) for both films, shape (c, 2), by the same columns."""
    moes = np.atleast_1d(line_film(*columns(keys, list(LINE_RANGES)[:2])))
    return np.stack([moes, moes], axis=1)


class LineShape(Shape):
    """Waves of line contacts: the law of slender contacts with the same alphabar and L.

    Waves are transverse: angles are 0.
    """

    def __init__(self, m: ArrayLike, l: ArrayLike) -> None:  # noqa: E741
        """Compute the values that follow from M and L."""
        self.l = np.asarray(l, dtype=float)
        self.load = SLENDER_OVER_LINE * np.asarray(m, dtype=float) ** 1.5
        film = line_film(m, l) / moes_per_line_film(m)
        self._log_film, self._inlet = np.log(film), INLET_SCALE * film ** (-2 / 3)

    @classmethod
    def of_keys(cls, keys: Mapping[str, ArrayLike]) -> "LineShape":
        """Return the shape of contacts given by columns named as the input keys."""
        return cls(*columns(keys, list(LINE_RANGES)[:2]))

    def seen(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Seen:
        """Return waves by ln x, x = 0.18 (lambda/a) H^(-2/3) L^(1/6), ln(lambda/a) and ln H."""
        wave = np.asarray(wavelength_over_a, dtype=float)
        x = self._inlet * wave * self.l ** (1 / 6)
        law = transfer_along(self.load, self.l, wave, np.ones(wave.shape))
        return rolling_seen((np.log(x), np.log(wave), self._log_film), law, wave / np.pi)
