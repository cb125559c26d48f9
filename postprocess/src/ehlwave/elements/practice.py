"""Figures that practice uses beside computed films: kappa, specific film, estimates of loads.

- kappa of ISO 281:2007: viscosity over the reference viscosity nu1, 45000 n^-0.83 dm^-0.5 below
  1000 rpm and 4500 n^-0.5 dm^-0.5 above, in mm2/s, rpm and mm.
- Specific film of ISO/TR 15144-1: h = 1600 rho G^0.6 U^0.7 W^-0.13 S^0.22 over the mean of both
  Ra, in um and mm. Formula and mean Ra as Jbily and others (2024, Procedia Structural Integrity 57,
  p. 211) restate them from ISO/TS 6336-22:2018, which followed the report; G, U, W
  and S from memory of the first edition (2010).
- Stribeck's estimate of the largest load in a bearing: 5 F/Z (balls), 4 F/Z (rollers).
"""

import math

from ehlwave.contact.data_sheet import Oil

FAST_RPM = 1000.0


def reference_viscosity_mm2_per_s(speed_rpm: float, mean_diameter_m: float) -> float:
    """Return nu1 of ISO 281, mm2/s.

    Parameters
    ----------
    speed_rpm : float
        Of a ring relative to the other.
    mean_diameter_m : float
        Mean diameter of the bearing.

    Examples
    --------
    A 6208 at 3000 rpm:

    >>> from ehlwave.elements.practice import reference_viscosity_mm2_per_s
    >>> print(f"{reference_viscosity_mm2_per_s(3000, 0.06):.1f} mm2/s")
    10.6 mm2/s
    """
    n, dm = abs(speed_rpm), 1e3 * mean_diameter_m
    if n < FAST_RPM:
        return 45000 * n**-0.83 * dm**-0.5
    return 4500 * n**-0.5 * dm**-0.5


def viscosity_ratio(oil: Oil, speed_rpm: float, mean_diameter_m: float) -> float:
    """Return kappa of ISO 281; NaN where the density of the oil is not known.

    Parameters
    ----------
    oil : Oil
        At the temperature of the bearing.
    speed_rpm, mean_diameter_m : float
        As of :func:`reference_viscosity_mm2_per_s`.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements.practice import viscosity_ratio
    >>> oil = ehlwave.Oil.from_grade(iso_vg=68, viscosity_index=95, temperature_k=343.15)
    >>> print(f"{viscosity_ratio(oil, 3000, 0.06):.1f}")
    1.9
    """
    if oil.density_kg_per_m3 is None:
        return math.nan
    kinematic = 1e6 * oil.viscosity_pa_s / oil.density_kg_per_m3
    return kinematic / reference_viscosity_mm2_per_s(speed_rpm, mean_diameter_m)


def iso_gear_film_m(
    radius_m: float,
    speed_sum_m_per_s: float,
    hertz_pressure_pa: float,
    reduced_modulus_pa: float,
    oil: Oil,
    rise_k: float = 0.0,
) -> float:
    """Return the film of ISO/TR 15144-1, m.

    The sliding parameter S takes viscosity and alpha at the temperature of the surfaces in the
    contact. Here that is the inlet plus the rise that :class:`ehlwave.Contact` finds with heat, in
    place of the flash temperature of the report.

    Parameters
    ----------
    radius_m, speed_sum_m_per_s, hertz_pressure_pa, reduced_modulus_pa : float
        Normal radius, sum of both speeds, largest Hertz pressure, E'.
    oil : Oil
        At the temperature of the bulk.
    rise_k : float
        Of the surfaces in the contact.

    Examples
    --------
    >>> import ehlwave
    >>> from ehlwave.elements.practice import iso_gear_film_m
    >>> oil = ehlwave.Oil(viscosity_pa_s=0.02, pressure_viscosity_per_pa=2e-8)
    >>> print(f"{iso_gear_film_m(8.39e-3, 6.6, 1.55e9, 2.26e11, oil) * 1e6:.2f} um")
    0.29 um
    """
    modulus_mpa, radius_mm = 1e-6 * reduced_modulus_pa, 1e3 * radius_m
    g = 1e6 * oil.pressure_viscosity_per_pa * modulus_mpa
    u = oil.viscosity_pa_s * speed_sum_m_per_s / (2000 * modulus_mpa * radius_mm)
    w = 2 * math.pi * (1e-6 * hertz_pressure_pa) ** 2 / modulus_mpa**2
    beta = oil.viscosity_temperature_per_k or 0.0
    warm = math.exp(-beta * rise_k) * _alpha_ratio(oil.temperature_k, rise_k)
    return 1e-6 * 1600 * radius_mm * g**0.6 * u**0.7 * w**-0.13 * warm**0.22


def _alpha_ratio(temperature_k: float | None, rise_k: float) -> float:
    """Return alpha at a rise over alpha at the temperature: 1 + 516 (1/T - 1/311) over itself."""
    if temperature_k is None or rise_k == 0:
        return 1.0
    warm, cold = (1 + 516 * (1 / t - 1 / 311) for t in (temperature_k + rise_k, temperature_k))
    return warm / cold


def stribeck_load_n(radial_load_n: float, elements: int, is_ball: bool) -> float:
    """Return the largest load on a ball or roller by Stribeck's estimate.

    Parameters
    ----------
    radial_load_n, elements, is_ball
        Of the bearing.

    Examples
    --------
    >>> from ehlwave.elements.practice import stribeck_load_n
    >>> stribeck_load_n(10800, 9, is_ball=False)
    4800.0
    """
    return (5 if is_ball else 4) * radial_load_n / elements
