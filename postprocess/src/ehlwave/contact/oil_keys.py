"""The oil that keys of input files give."""

from collections.abc import Mapping

from ehlwave.contact.oils import Oil
from ehlwave.errors import SurfaceError

CARREAU_KEYS = ("carreau_modulus_pa", "carreau_exponent")
OIL_KEYS = ("pressure_viscosity_per_pa", "roelands_index", "eyring_stress_pa", *CARREAU_KEYS)


def oil_of_keys(values: Mapping[str, float], place: str) -> Oil:
    """Return the oil; raise SurfaceError where keys belong to no flow law."""
    alpha = values.get("pressure_viscosity_per_pa", Oil.pressure_viscosity_per_pa)
    index = values.get("roelands_index", Oil.roelands_index)
    given = [key for key in ("eyring_stress_pa", *CARREAU_KEYS) if key in values]
    if not given:
        return Oil(alpha, index)
    if given not in (["eyring_stress_pa"], [*CARREAU_KEYS]):
        raise SurfaceError(
            f"{place}: {', '.join(given)}: give eyring_stress_pa of a Ree-Eyring oil, or "
            f"{' and '.join(CARREAU_KEYS)} of a Carreau oil"
        )
    if "reduced_modulus_pa" not in values:
        raise SurfaceError(f"{place}: {given[0]} needs reduced_modulus_pa beside M, L and D")
    exponent = values.get("carreau_exponent")
    if exponent is not None and exponent > 1:
        raise SurfaceError(f"{place}: carreau_exponent = {exponent:g} must be at most 1")
    return Oil(alpha, index, values[given[0]] * values["reduced_modulus_pa"], exponent)
