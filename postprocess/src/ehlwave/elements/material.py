"""Materials of elements: a name, or elastic constants, which override the name."""

from typing import Any

from ehlwave.contact.materials import material as known_material
from ehlwave.errors import SurfaceError


def elastic_of(
    material: str, elastic_modulus_pa: float | None = None, poisson_ratio: float | None = None
) -> dict[str, Any]:
    """Return arguments of :class:`ehlwave.Body`; thermal properties come from the named material.

    Parameters
    ----------
    material : str
        As of :class:`ehlwave.Body`.
    elastic_modulus_pa, poisson_ratio : float, optional
        In place of the material's.

    Examples
    --------
    >>> from ehlwave.elements.material import elastic_of
    >>> elastic_of("steel", elastic_modulus_pa=2.1e11)["poisson_ratio"]
    0.3
    """
    if elastic_modulus_pa is None and poisson_ratio is None:
        return {"material": material}
    known = known_material(material)
    found: dict[str, Any] = {
        "elastic_modulus_pa": known[0] if elastic_modulus_pa is None else elastic_modulus_pa,
        "poisson_ratio": known[1] if poisson_ratio is None else poisson_ratio,
    }
    return found | known.heat._asdict()


def both_elastic(
    material: str | tuple[str, str],
    elastic_modulus_pa: float | None,
    poisson_ratio: float | None,
    place: str,
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return arguments of both bodies.

    Parameters
    ----------
    material : str or pair of str
        Of both bodies, or of each.
    elastic_modulus_pa, poisson_ratio : float, optional
        As of :func:`elastic_of`.
    place : str
        Name of the element, for messages.
    """
    both = (material, material) if isinstance(material, str) else tuple(material)
    if len(both) != 2:
        raise SurfaceError(f"{place}: material = {material!r:.60}: give one name, or two")
    first, second = (elastic_of(one, elastic_modulus_pa, poisson_ratio) for one in both)
    return first, second
