"""Elements in TOML files: dimensions, conditions, oil and roughness of one element."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ehlwave.contact.data_sheet import Oil
from ehlwave.elements.angular_contact_ball_bearing import AngularContactBallBearing
from ehlwave.elements.ball_on_disc import BallOnDisc
from ehlwave.elements.cam_follower import CamFollower
from ehlwave.elements.cylindrical_roller_bearing import CylindricalRollerBearing
from ehlwave.elements.deep_groove_ball_bearing import DeepGrooveBallBearing
from ehlwave.elements.helical_gear_pair import HelicalGearPair
from ehlwave.elements.mini_traction import MiniTraction
from ehlwave.elements.place import ElementContact
from ehlwave.elements.spur_gear_pair import SpurGearPair
from ehlwave.elements.tapered_roller_bearing import TaperedRollerBearing
from ehlwave.elements.two_disc import TwoDisc
from ehlwave.errors import SurfaceError, did_you_mean

CALLS: dict[str, tuple[type, str]] = {
    kind.__name__: (kind, call)
    for call, kinds in {
        "over_speeds": (BallOnDisc, MiniTraction, TwoDisc),
        "over_load_zone": (
            *(DeepGrooveBallBearing, AngularContactBallBearing),
            *(CylindricalRollerBearing, TaperedRollerBearing),
        ),
        "along_path": (SpurGearPair, HelicalGearPair),
        "over_cycle": (CamFollower,),
    }.items()
    for kind in kinds
}
"""Class of each element, and its one call."""

KINDS = {
    "bearing": tuple(name for name, (_, call) in CALLS.items() if call == "over_load_zone"),
    "gear": tuple(name for name, (_, call) in CALLS.items() if call == "along_path"),
    "cam": tuple(name for name, (_, call) in CALLS.items() if call == "over_cycle"),
    "rig": tuple(name for name, (_, call) in CALLS.items() if call == "over_speeds"),
}
"""Elements by the command that answers for them."""

TABLES = ("dimensions", "conditions", "oil", "surface")
BOUNDARY = ("bore_m", "outside_m", "width_m")


@dataclass(frozen=True)
class ElementDocument:
    """An element and its questions.

    Attributes
    ----------
    name : str
        Name of the element.
    given : mapping
        The tables of the file.
    folder : Path
        Of the file, from which names of traces count.
    """

    name: str
    given: Mapping[str, Any]
    folder: Path

    def element(self) -> Any:  # noqa: ANN401 - one of ten classes
        """Return the element.

        Raises
        ------
        SurfaceError
            If a dimension is unknown, missing or makes no sense.
        """
        kind = CALLS[self.name][0]
        dimensions = dict(self.given.get("dimensions", {}))
        if self.name == "CamFollower" and "lift_file" in dimensions:
            lift = np.loadtxt(self.folder / dimensions.pop("lift_file"), delimiter=",", ndmin=2)
            dimensions |= {"angle_deg": lift[:, 0], "lift_m": lift[:, 1]}
        make: Callable[..., Any] = kind
        if BOUNDARY[0] in dimensions and hasattr(kind, "from_boundary"):
            make = kind.from_boundary
        _check_names(make, dimensions, "dimensions", self.name)
        return make(**dimensions)

    def oil(self) -> Oil:
        """Return the oil by its data sheet or by its properties."""
        sheet = dict(self.given.get("oil", {}))
        if not sheet:
            raise SurfaceError("[oil] is missing: give iso_vg and temperature_k, such as 343.15")
        if "name" in sheet:
            return Oil.named(sheet.pop("name"), **sheet)
        if "viscosity_pa_s" not in sheet:
            return Oil.from_grade(**sheet)
        _check_names(Oil, sheet, "oil", "Oil")
        return Oil(**sheet)

    def asked(self) -> dict[str, Any]:
        """Return conditions and questions as arguments of the call."""
        asked = dict(self.given.get("conditions", {}))
        surface = dict(self.given.get("surface", {}))
        for name in ("trace", "second"):
            if name in surface:
                asked[name] = self.folder / surface.pop(name)
        if "stress" in surface:
            asked["stress"] = surface.pop("stress")
        if surface:
            asked["reading"] = surface
        return asked | ({"heat": True} if self.given.get("heat") else {})

    def places(self) -> list[ElementContact]:
        """Return the contacts of the element, as cases of a sweep have them."""
        conditions = dict(self.given.get("conditions", {}))
        for key in ("oil_over_flooded", "oil_layer_m", "by"):
            conditions.pop(key, None)
        found: list[ElementContact] = self.element().places(oil=self.oil(), **conditions)
        return found

    def table(self, **more: Any) -> xr.Dataset:  # noqa: ANN401
        """Return the table of the element.

        Parameters
        ----------
        **more
            Arguments of the call, such as ``trace``, which override the file.
        """
        element = self.element()
        call = getattr(element, CALLS[self.name][1])
        asked = self.asked() | more
        known = {*inspect.signature(call).parameters, "trace", "second", "heat", "stress"}
        known |= {"reading", "oil_over_flooded", "oil_layer_m", "by"}
        if hasattr(element, "load_zone"):
            known |= set(inspect.signature(element.load_zone).parameters)
        for key in asked:
            if key not in known:
                raise SurfaceError(
                    f"conditions: unknown {key}{did_you_mean(key, known)}; {self.name} has "
                    f"{', '.join(sorted(known - {'asked', 'oil', 'rings', 'reading'}))}"
                )
        missing = [
            name
            for name, one in inspect.signature(call).parameters.items()
            if one.default is one.empty
            and one.kind is one.KEYWORD_ONLY
            and name not in (*asked, "oil")
        ]
        if missing:
            raise SurfaceError(f"conditions: {missing[0]} is missing: give it under [conditions]")
        found: xr.Dataset = call(oil=self.oil(), **asked)
        return found


def read_element(path: str | Path, kind: str | None = None) -> ElementDocument:
    """Return the element of a TOML file.

    Parameters
    ----------
    path : path
        With ``element``, ``[dimensions]``, ``[conditions]``, ``[oil]`` and, for roughness,
        ``[surface]``; ``heat = true`` for films and friction with heat.
    kind : str, optional
        ``"bearing"``, ``"gear"``, ``"cam"`` or ``"rig"``, which the element must be of.

    Raises
    ------
    SurfaceError
        If the file cannot be read, or names something that there is not.
    """
    place = Path(path)
    given = _toml(place)
    allowed = tuple(CALLS) if kind is None else KINDS[kind]
    name = given.get("element")
    if name not in allowed:
        raise SurfaceError(
            f"{place}: element = {name!r}: give one of {', '.join(allowed)}"
            f"{did_you_mean(str(name), allowed)}"
        )
    for key in given:
        if key not in (*TABLES, "element", "heat"):
            known = ("element", "heat", *TABLES)
            raise SurfaceError(f"{place}: unknown {key}{did_you_mean(key, known)}")
    return ElementDocument(str(name), given, place.parent)


def _toml(place: Path) -> dict[str, Any]:
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib

    try:
        return tomllib.loads(place.read_text(encoding="utf-8"))
    except OSError as error:
        raise SurfaceError(f"{place}: {error.strerror or error}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SurfaceError(f"{place}: not a TOML file ({error})") from error


def _check_names(
    make: Callable[..., Any], given: Mapping[str, Any], table: str, element: str
) -> None:
    """Refuse names that the element does not have, and name those that are missing."""
    parameters = inspect.signature(make).parameters
    for key in given:
        if key not in parameters:
            raise SurfaceError(
                f"{table}: unknown {key}{did_you_mean(key, parameters)}; {element} has "
                f"{', '.join(parameters)}"
            )
    for name, one in parameters.items():
        if one.default is one.empty and name not in given:
            raise SurfaceError(f"{table}: {name} is missing: {element} needs it")
