"""Friction over the slide-to-roll ratio: isothermal, with heat, and with a limit of the stress."""

from ehlwave.traction.answer import traction
from ehlwave.traction.figure import traction_figure
from ehlwave.traction.given import read_keys
from ehlwave.traction.table import CURVES, Traction, regimes

__all__ = ["CURVES", "Traction", "read_keys", "regimes", "traction", "traction_figure"]
