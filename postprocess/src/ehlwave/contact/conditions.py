"""Operating conditions of a contact: an operating point and its lengths.

Equation numbers refer to ``src/theory.md``.
"""

from dataclasses import dataclass, field
from functools import cached_property

from ehlwave.contact.equality import equal_fields
from ehlwave.contact.formula import v
from ehlwave.contact.line_contact import (
    SLENDER_OVER_LINE,
    line_alphabar,
    line_lambdabar,
)
from ehlwave.contact.medium import Medium, hertz_medium
from ehlwave.contact.oils import Oil
from ehlwave.contact.scales import (
    alphabar,
    corrected_film,
    first_integral,
    lambdabar,
)
from ehlwave.contact.starvation import FILM_BAR
from ehlwave.contact.thinning import NEARLY_NEWTONIAN, film_loss, stresses_in_inlet
from ehlwave.duals import math, to_float
from ehlwave.error_bars import bar

MOES_KEYS = ("load_parameter_m", "lubricant_parameter_l", "radius_ratio_d")

THINNING_ERROR = bar("film.thinned")

FIT_TEXT = "the film thickness fit of Nijenbanning, Venner and Moes (1994)"
LINE_FIT_TEXT = "the film thickness fit of Moes (1992) for line contacts"
GIVEN_TEXT = "given (central_film_m)"
FIT_ERROR, LINE_FIT_ERROR = bar("film.formula"), bar("film.formula_line")


@dataclass(frozen=True)
class Conditions:
    """An operating point, with the lengths that turn metres into its units.

    Attributes
    ----------
    m, l, d : float
        Moes load and lubricant parameters, and D = Rx/Ry; 0: line contact, whose M has another
        definition.
    kappa : float
        Ellipticity a/b, eq. (1); 0 of a line contact.
    gamma : float
        Pressure factor of the ellipticity, 1 for a circular contact, M^(1/2) for a line contact.
    slip_parameter : float
        S = u1/ubar of the rough surface; 1 is pure rolling.
    semi_axis_a_m : float
        Hertz semi-axis in the rolling direction, m.
    central_film_m : float or None
        Central film thickness of the smooth contact, m; None when M, L and D came without a
        radius and without a film thickness.
    hertz_approach_c_m : float or None
        Hertz approach c, m: the unit of H in results.
    film_source : str
        Where the film thickness comes from.
    oil : Oil
        Further parameters of waves under slip.
    metres_per_moes : float or None
        Film in m per unit in the Moes scale.
    central_film_error : float or None
        Relative error of the central film; 0 for a given film; None: unknown.
    oil_error : float
        Relative film error from errors of viscosity and pressure-viscosity coefficient.
    oil_over_flooded : float or None
        r of a starved contact, oil offered over oil that the flooded contact passes; None: flooded.
    film_ratio : float
        R, the central film over the flooded film, by the law of starved contacts; 1 if flooded. It
        is in `central_film_m`.
    given : tuple of pairs
        Keys and values that it was given by, SI.
    names : tuple of triples
        Key, name and factor of quantities given under other names: a value of the key times the
        factor is the named quantity.
    """

    m: float
    l: float  # noqa: E741 - the paper's letter
    d: float
    kappa: float
    gamma: float
    slip_parameter: float
    semi_axis_a_m: float
    hertz_approach_c_m: float | None
    central_film_m: float | None
    film_source: str
    oil: Oil = field(default_factory=Oil)
    metres_per_moes: float | None = None
    central_film_error: float | None = None
    oil_error: float = 0.0
    oil_over_flooded: float | None = None
    film_ratio: float = 1.0
    given: tuple[tuple[str, float], ...] = field(default=(), repr=False, compare=False)
    names: tuple[tuple[str, str, float], ...] = field(default=(), repr=False, compare=False)
    __eq__ = equal_fields

    @property
    def semi_axis_b_m(self) -> float:
        """Hertz semi-axis across the rolling direction, b = a/kappa, m."""
        return math.inf if self.is_line else self.semi_axis_a_m / self.kappa

    @property
    def is_line(self) -> bool:
        """Whether it is a line contact, without end across rolling."""
        return self.d == 0

    @property
    def slender_gamma(self) -> float:
        """Return gamma for laws of elliptical contacts, which depend on alphabar and L alone."""
        return self.gamma * (SLENDER_OVER_LINE if self.is_line else 1.0)

    @property
    def v_per_wavelength(self) -> float:
        """V = (lambda/a)(gamma M/L)^(1/2) for a wavelength of 1 m, eq. (17), 1/m."""
        return to_float(v(1 / self.semi_axis_a_m, self.m, self.l, self.gamma))

    @property
    def alphabar(self) -> float:
        """Return alpha ph, eq. (3)."""
        if self.is_line:
            return to_float(line_alphabar(self.m, self.l))
        return alphabar(self.m, self.l, self.gamma)

    @property
    def hertz_pa(self) -> float:
        """Return the largest Hertz pressure ph, Pa."""
        return self.alphabar / self.oil.pressure_viscosity_per_pa

    @property
    def modulus_pa(self) -> float | None:
        """Return E' by ph and the lengths, Pa: 2 K a ph/c; None without lengths.

        The deflection under a pressure ph cos(k x) is 4 ph/(E' k), 2 c/(K k a) by the scales.
        """
        if self.hertz_approach_c_m is None:
            return None
        k = first_integral(self.kappa)
        return 2 * k * self.semi_axis_a_m * self.hertz_pa / self.hertz_approach_c_m

    @property
    def peak_over_mean(self) -> float:
        """Return the largest Hertz pressure over the mean Hertz pressure."""
        return 4 / math.pi if self.is_line else 1.5

    @property
    def lambdabar(self) -> float:
        """Return the speed parameter, eq. (4)."""
        if self.is_line:
            return line_lambdabar(self.m)
        return lambdabar(self.m, self.kappa)

    def medium(self, slip: float) -> Medium:
        """Return the state of the contact centre for small waves of a surface with this slip.

        The film is the given film; where a formula gave it, or it is unknown, the film of
        :func:`corrected_film`.
        """
        if self.hertz_approach_c_m is None or self.film_source == FIT_TEXT:
            film = corrected_film(self.m, self.l, self.d)
        else:
            film = (self.central_film_m or math.nan) / self.hertz_approach_c_m
        return hertz_medium(self.oil, self.kappa, self.alphabar, self.lambdabar, film, slip)

    @property
    def has_given_film(self) -> bool:
        """Whether the central film is given."""
        return self.film_source == GIVEN_TEXT

    @property
    def is_starved(self) -> bool:
        """Whether less oil is offered than fills the inlet, `oil_over_flooded`."""
        return self.oil_over_flooded is not None

    @property
    def starvation_error(self) -> float:
        """Return the relative film error from the error of R; 0 for a flooded contact."""
        return FILM_BAR / self.film_ratio if self.is_starved else 0.0

    @property
    def rolls(self) -> bool:
        """Whether both surfaces have one speed, S = 1."""
        return self.slip_parameter == 1

    @property
    def slide_to_roll_ratio(self) -> float:
        """Return the difference of the surface speeds over the mean speed, 2 (S - 1)."""
        return 2 * (self.slip_parameter - 1)

    @property
    def has_atlas(self) -> bool:
        """Whether it has an atlas: pure rolling, or a kind of sliding contact with an atlas."""
        return self.rolls or self.has_sliding_atlas or self.is_newtonian_line

    @property
    def is_newtonian_line(self) -> bool:
        """Whether it is a line contact of an oil that slip does not thin: its film is rolling's."""
        return self.is_line and self.oil.name == "Newtonian"

    @property
    def film_slip(self) -> float:
        """Return the S by which the atlas has its film: 1 where slip does not change it."""
        return 1.0 if self.is_newtonian_line else self.slip_parameter

    @property
    def has_sliding_atlas(self) -> bool:
        """Whether the atlas of sliding contacts applies: a shear-thinning Ree-Eyring oil."""
        if self.oil.name != "Ree-Eyring":
            return False
        return not self.rolls or self.film_loss > NEARLY_NEWTONIAN

    @property
    def film_loss(self) -> float:
        """Return by how much thinner than of a Newtonian oil the film is at most; inf: unknown."""
        return film_loss(self.oil, self.l, *self.stresses_in_inlet)

    @cached_property
    def stresses_in_inlet(self) -> tuple[float, float]:
        """Return the stresses in the inlet due to pressure and slip, over the oil's own stress."""
        moes = self.m, self.l, self.d
        return stresses_in_inlet(
            self.oil, moes, self.kappa, self.alphabar, self.lambdabar, self.slip_parameter
        )

    @property
    def rolling_film_error(self) -> float:
        """Return by how much less than in pure rolling the film may be, relative: oils thin."""
        is_thinned = not self.rolls and self.oil.name != "Newtonian"
        return THINNING_ERROR if is_thinned else 0.0

    def atlas_keys(self) -> dict[str, float]:
        """Return the coordinates of the contact in the atlases, by their keys."""
        keys = {
            "load_parameter_m": self.m,
            "lubricant_parameter_l": self.l,
            "radius_ratio_d": self.d,
            "pressure_viscosity_per_pa": self.oil.pressure_viscosity_per_pa,
            "roelands_index": self.oil.roelands_index,
        }
        if self.is_line:
            del keys["radius_ratio_d"]
        if self.is_newtonian_line and not self.rolls:
            keys["slip_parameter"] = self.slip_parameter
        if self.oil.name == "Ree-Eyring" and self.oil.stress_modulus_pa2 is not None:
            keys["slip_parameter"] = self.slip_parameter
            keys["stress_modulus_pa2"] = self.oil.stress_modulus_pa2
        return keys
