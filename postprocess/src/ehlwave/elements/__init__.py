"""Machine elements: from catalogue data to the contacts of bearings, gears, cams and test rigs.

One module an element. Each has its contacts, and a method that computes all of them:
``over_load_zone`` of bearings, ``along_path`` of gears, ``over_cycle`` of cams, ``over_speeds`` of
test rigs. Modules are imported on first use.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ehlwave.elements.angular_contact_ball_bearing import AngularContactBallBearing
    from ehlwave.elements.ball_on_disc import BallOnDisc
    from ehlwave.elements.cam_follower import CamFollower
    from ehlwave.elements.cylindrical_roller_bearing import CylindricalRollerBearing
    from ehlwave.elements.deep_groove_ball_bearing import DeepGrooveBallBearing
    from ehlwave.elements.document import read_element
    from ehlwave.elements.figure import element_figure
    from ehlwave.elements.helical_gear_pair import HelicalGearPair
    from ehlwave.elements.mini_traction import MiniTraction
    from ehlwave.elements.report import report_html, report_json
    from ehlwave.elements.spur_gear_pair import SpurGearPair
    from ehlwave.elements.sweep_table import case_table, write_sweep
    from ehlwave.elements.tapered_roller_bearing import TaperedRollerBearing
    from ehlwave.elements.two_disc import TwoDisc

_HOMES = {
    "AngularContactBallBearing": "angular_contact_ball_bearing",
    "BallOnDisc": "ball_on_disc",
    "CamFollower": "cam_follower",
    "CylindricalRollerBearing": "cylindrical_roller_bearing",
    "DeepGrooveBallBearing": "deep_groove_ball_bearing",
    "HelicalGearPair": "helical_gear_pair",
    "MiniTraction": "mini_traction",
    "SpurGearPair": "spur_gear_pair",
    "TaperedRollerBearing": "tapered_roller_bearing",
    "TwoDisc": "two_disc",
    "case_table": "sweep_table",
    "element_figure": "figure",
    "read_element": "document",
    "report_html": "report",
    "report_json": "report",
    "write_sweep": "sweep_table",
}

__all__ = [
    "AngularContactBallBearing",
    "BallOnDisc",
    "CamFollower",
    "CylindricalRollerBearing",
    "DeepGrooveBallBearing",
    "HelicalGearPair",
    "MiniTraction",
    "SpurGearPair",
    "TaperedRollerBearing",
    "TwoDisc",
    "case_table",
    "element_figure",
    "read_element",
    "report_html",
    "report_json",
    "write_sweep",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401
    """Import a module on request."""
    from importlib import import_module

    if name in _HOMES:
        return getattr(import_module(f"ehlwave.elements.{_HOMES[name]}"), name)
    raise AttributeError(f"module 'ehlwave.elements' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the names that can be asked for."""
    return [*__all__]
