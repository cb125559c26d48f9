"""Friction, film and share of the solids over the speed: Stribeck curves of mixed lubrication."""

from ehlwave.stribeck.curve import Stribeck, stribeck
from ehlwave.stribeck.figure import stribeck_figure

__all__ = ["Stribeck", "stribeck", "stribeck_figure"]
