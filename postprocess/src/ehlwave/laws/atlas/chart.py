"""The responses and films of a contact, from an atlas."""

from collections.abc import Mapping
from dataclasses import dataclass

from numpy.typing import ArrayLike

from ehlwave.duals import math, np, to_float, valued
from ehlwave.error_bars import bar
from ehlwave.errors import RangeError
from ehlwave.laws.atlas.coordinates import Complex, Floats
from ehlwave.laws.atlas.kind import is_within
from ehlwave.laws.atlas.networks import Networks
from ehlwave.laws.atlas.shape import Seen
from ehlwave.shown import Shown

RESPONSE_BY_FILM = bar("chart.response_by_film")
"""Change of a response, units of Ai, over the share of the film that thinning takes."""

DEVIATIONS = bar("chart.deviations")
"""Standard deviations between the networks of films that their errors cover at least."""


@dataclass(frozen=True)
class SmoothFilm:
    """Films of a smooth contact and their relative errors, two standard deviations.

    Attributes
    ----------
    central_moes, minimum_moes : float
        In the Moes scale, (h/Rx)(2U)^(-1/2) for elliptical contacts. The smallest film is NaN where
        the atlas has errors of 100 % and more.
    central_error, minimum_error : float
        Relative; 95 % of films computed anew are within it.
    stress : float or None
        Friction under slip of a Ree-Eyring oil: mean shear stress over the Eyring stress; None in
        pure rolling.
    stress_error : float or None
        Relative.
    """

    central_moes: float
    minimum_moes: float
    central_error: float
    minimum_error: float
    stress: float | None = None
    stress_error: float | None = None


@dataclass(frozen=True, repr=False)
class Responses(Shown):
    """Responses at the contact centre to waves, arrays of equal shape.

    Attributes
    ----------
    film : ndarray of complex
        Film over Ai; the surface is exp(i(kx X - w T)), positive where it widens the gap.
    pressure : ndarray of complex
        Amplitude of P over Ai, in units of ph/c.
    error : ndarray
        Of ``film``, absolute, in units of Ai; 95 % of responses computed anew are within it.
    rise : ndarray
        Rise of the mean film by a wave, over the film, per (A/film)^2: second order in its
        amplitude A.
    """

    film: Complex
    pressure: Complex
    error: Floats
    rise: Floats

    def _shown_rows(self) -> dict[str, str]:
        """Return how many waves there are, and the largest error."""
        return {"waves": str(self.film.size), "errors": f"up to {np.max(self.error):.2g}"}


class Chart:
    """The responses of a contact.

    Parameters
    ----------
    networks : Networks
        Of an atlas.
    keys : mapping
        Parameters of the contact, for the kind: :mod:`ehlwave.laws.atlas.ranges`.
    film_loss : float
        Relative thinning of the film against the atlas, for a shear-thinning oil and an atlas
        without thinning. Errors of films count it once, errors of responses
        :data:`RESPONSE_BY_FILM` times.
    thinned : Chart, optional
        Chart of the same contact in an atlas with thinning: films come from it, and the thinning is
        included in errors of responses.

    Raises
    ------
    RangeError
        If a coordinate lies outside its range, or all of them beyond a limit of the kind.
    """

    def __init__(
        self,
        networks: Networks,
        keys: Mapping[str, float],
        film_loss: float = 0.0,
        thinned: "Chart | None" = None,
    ) -> None:
        """Find its films, and how it sees waves."""
        self.film_loss = film_loss
        kind = networks.kind
        for key, (low, high) in kind.ranges.items():
            if not is_within(keys[key], low, high):
                name = "eyring_stress_pa reduced_modulus_pa" if "stress" in key else key
                raise RangeError(
                    f"{name} = {keys[key]:.5g} lies outside the atlas, which holds {low:g} to "
                    f"{high:g}: name a formula, or compute it (ehlwave.Case, a harmonic table)"
                )
        beyond = kind.beyond(keys)
        if beyond:
            raise RangeError(
                f"{beyond} lies outside the atlas: name a formula, or compute it (ehlwave.Case)"
            )
        self._networks = networks
        self._place = kind.coordinates(keys)
        self.film_numbers = networks.films(self._place)[0]
        """Return the coordinates of the films, as the kind of the atlas names them."""
        references = kind.references(keys)
        numbers = dict(zip(kind.films, self.film_numbers[:, None], strict=True))
        self._shape = kind.shape(kind.state(keys, references, numbers))
        self._references = references[0]
        self._smallest = (
            None if kind.smallest is None else kind.smallest(keys, self.ratio_of_networks())
        )
        self._thinned = thinned
        if thinned is not None:
            film = thinned.film()
            left = film.central_moes * (1 - film.central_error) / self.computed_films()[0]
            self.film_loss = max(0.0, 1 - left)

    @property
    def source(self) -> str:
        """Name of the atlas."""
        return self._networks.name

    @property
    def film_source(self) -> str:
        """Name of the atlas of the films."""
        return self.source if self._thinned is None else self._thinned.source

    def computed_films(self) -> tuple[float, float]:
        """Return central and smallest film, Moes scale, as the networks have them."""
        base, ratios = self._references, np.exp(self.film_numbers)
        return to_float(base[0] * ratios[0]), to_float(base[1] * ratios[0] * ratios[1])

    def ratio_of_networks(self) -> float:
        """Return the smallest over the central film by the networks, at most 1."""
        central, minimum = self.computed_films()
        return min(minimum / central, 1.0)

    def _film_errors(self) -> Floats:
        """Return the errors of the films; far from the data, where networks differ, they grow."""
        place = valued(self._place)
        errors = self._networks.film_errors(place)[0]
        return np.maximum(errors, DEVIATIONS * self._networks.films.deviation(place)[0])

    def film(self) -> SmoothFilm:
        """Return the smooth films, and the shear stress where the kind of the atlas has it.

        The smallest film is not above the central film, and NaN where unknown.
        """
        if self._thinned is not None:
            return self._thinned.film()
        errors = self._film_errors()
        central, minimum = self.computed_films()
        central_error = to_float(errors[0]) + self.film_loss
        minimum_error = to_float(errors[:2].sum()) + self.film_loss
        if self._smallest is not None:
            ratio, own = self._smallest
            minimum, minimum_error = ratio * central, central_error + own
        lowest = minimum * (1 - minimum_error)
        if not 0 < lowest < central * (1 + central_error):
            minimum = minimum_error = math.nan
        elif minimum > central:
            minimum = central
        has_stress = "friction_ratio" in self._networks.kind.films and self._references[2] > 0
        stress = self._references[2] * np.exp(self.film_numbers[2]) if has_stress else 0.0
        return SmoothFilm(
            central_moes=central,
            minimum_moes=minimum,
            central_error=central_error,
            minimum_error=minimum_error,
            stress=to_float(stress) if has_stress else None,
            stress_error=to_float(errors[2]) if has_stress else None,
        )

    def responses(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Responses:
        """Return responses to waves of these lengths along their wave vectors and directions.

        Parameters
        ----------
        wavelength_over_a : array_like
            0.1 to 4; nothing is checked here.
        angle_deg : array_like
            Between wave vector and rolling direction, in metres, 0 to 90; shape of the wavelengths.
        """
        wave, angle, shape = _flattened(wavelength_over_a, angle_deg)
        seen = self._shape.seen(wave, angle)
        inputs = self._inputs(seen)
        numbers = self._networks.waves(inputs)
        film = seen.film(numbers)
        error = self._networks.errors(valued(inputs))[:, 0] + RESPONSE_BY_FILM * self.film_loss
        found = film, seen.pressure(film, numbers), error, numbers[:, -1]
        return Responses(*(values.reshape(shape) for values in found))

    def film_response(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Complex:
        """Return film responses alone; arguments as of :meth:`responses`."""
        wave, angle, shape = _flattened(wavelength_over_a, angle_deg)
        return self.film_of(self._shape.seen(wave, angle)).reshape(shape)

    def film_of(self, seen: Seen) -> Complex:
        """Return film responses alone, to waves as the contact sees them."""
        return seen.film(self._networks.waves(self._inputs(seen)))

    def _inputs(self, seen: Seen) -> Floats:
        return with_contacts(self._place, seen.coordinates)


def with_contacts(contacts: Floats, waves: Floats) -> Floats:
    """Return the coordinates of contacts, one or one per wave, before the coordinates of waves."""
    shape = len(waves), contacts.shape[1]
    return np.concatenate([np.broadcast_to(contacts, shape), waves], axis=1)


def _flattened(wave: ArrayLike, angle_deg: ArrayLike) -> tuple[Floats, Floats, tuple[int, ...]]:
    """Return waves as columns, and their shape."""
    waves, angles = np.broadcast_arrays(
        np.asarray(wave, dtype=float), np.asarray(angle_deg, dtype=float)
    )
    return waves.ravel(), angles.ravel(), waves.shape
