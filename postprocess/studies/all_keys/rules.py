"""Keys whose values follow from the contact and from keys that were drawn before.

Each function returns the value of a key in a row, or None for a key that is not given.
"""

from collections.abc import Callable
from typing import Any

from studies.all_keys.random_contact import MODULUS_PA, Contact

CELLS = (24, 32, 48, 50, 64, 64, 72, 80, 96, 96, 96, 112)
ONE_LENGTH = ("transverse", "isotropic", "longitudinal")
"""Patterns given by a single wavelength."""
SPECIAL_LAWS = ("mcewen", "yasutomi", "doolittle", "table")

Value = float | int | bool | str | None
Row = dict[str, Any]
Draw = Callable[[Contact, Row], Value]


def slip(c: Contact, row: Row) -> Value:
    """Return S, now and then of a surface at rest."""
    if c.chance(0.4):
        return None
    return c.one_of(0.0, 2.0) if c.chance(0.05) else round(c.between(0.25, 1.75), 2)


def ratio(c: Contact, row: Row) -> Value:
    """Return the slide-to-roll ratio, in place of S."""
    return None if "slip_parameter" in row or c.chance(0.5) else round(c.between(-1.5, 1.5), 2)


def modulus(c: Contact, row: Row) -> Value:
    """Return the reduced modulus, from the data where the contact has dimensions."""
    return MODULUS_PA if c.is_dimensional else c.power(5e10, 3e11)


def law(c: Contact, row: Row) -> Value:
    """Return the law of viscosity; with dimensions it has a coefficient."""
    if c.warm_law:
        return c.warm_law
    if c.is_dimensional or c.chance(0.55):
        return c.one_of("roelands", "roelands", "barus") if c.chance(0.5) else None
    return c.one_of("barus", "isoviscous", *SPECIAL_LAWS)


def orientation(c: Contact, row: Row) -> Value:
    """Return the pattern; heat and lines leave few of them."""
    if (c.is_warm and not c.has_warm_waves) or c.has_surface or c.chance(0.3):
        return None
    return "transverse" if c.is_line else c.one_of(*ONE_LENGTH, "transverse", "custom")


def wave_y(c: Contact, row: Row) -> Value:
    """Return the wavelength across of a custom pattern, which has at least one of both."""
    if row.get("orientation") != "custom":
        return None
    if row["wavelength_x_over_a"] == 0:
        return c.power(0.5, 2.5)
    return 0.0 if c.chance(0.3) else c.power(0.5, 2.5)


def orientation_2(c: Contact, row: Row) -> Value:
    """Return the waves of surface 2; in marches they have to move."""
    if "orientation" not in row or not c.chance(0.15):
        return None
    stands = c.is_line or row.get("response") != "harmonic"
    return "transverse" if stands else c.one_of(*ONE_LENGTH, "custom")


def response(c: Contact, row: Row) -> Value:
    """Return the method for the response to waves; periodic states exclude heat."""
    if "orientation" not in row:
        return None
    periodic = () if c.is_warm else ("periodic",)
    return c.one_of("harmonic", "harmonic", "harmonic", "transient", *periodic, "both")


def cells(c: Contact, row: Row) -> Value:
    """Return cells along X or Y, 0 (the program chooses) now and then."""
    if c.accuracy:
        return None if c.chance(0.9) else 96
    return 0 if c.chance(0.25) else c.one_of(*CELLS) * (3 if c.is_line else 1)


def step(c: Contact, row: Row) -> Value:
    """Return the time step over the cell."""
    if row.get("orientation") is None or row.get("response") in ("harmonic", "both", "periodic"):
        return 0.5 if c.chance(0.1) else None
    return c.one_of(0.5, 2, 1) if c.chance(0.3) else None


def method(c: Contact, row: Row) -> Value:
    """Return the method, if there is a choice."""
    if c.is_line or c.chance(0.6) or {"oil_over_flooded", "oil_layer_m"} & set(row):
        return None
    return c.one_of("fas", "fas", "newton", "petsc")


def scheme(c: Contact, row: Row) -> Value:
    """Return the scheme of the Reynolds equation, if there is a choice."""
    starved = {"oil_over_flooded", "oil_layer_m"} & set(row)
    return None if c.is_warm or starved else c.scheme


def oil(c: Contact, row: Row) -> Value:
    """Return the oil over the flow of the flooded contact, in pure rolling."""
    rolls = row.get("slip_parameter", 1) == 1 or row.get("orientation") is None
    if not rolls or row.get("response") == "periodic" or c.has_surface or c.is_warm:
        return None
    if not c.chance(0.12):
        return None
    return c.power(0.3, 5)


def layer(c: Contact, row: Row) -> Value:
    """Return a layer in metres; of many contacts it is more than they take."""
    if "radius_x_m" not in row or "oil_over_flooded" in row or oil(c, row) is None:
        return None
    return c.power(1e-7, 1e-5)


def end(c: Contact, row: Row) -> Value:
    """Return the end of a march."""
    if row.get("response") in ("harmonic", "periodic") or not c.chance(0.08):
        return None
    return c.between(1, 6)


def beta(c: Contact, row: Row) -> Value:
    """Return the coefficient of temperature, of laws that have none of their own."""
    has_own = row.get("viscosity_law") in ("yasutomi", "doolittle", "table")
    return None if has_own else c.between(0.02, 0.06)
