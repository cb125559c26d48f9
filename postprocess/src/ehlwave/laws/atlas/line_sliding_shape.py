"""Waves under slip as the atlas of line contacts that slide sees them."""

from collections.abc import Mapping

from numpy.typing import ArrayLike

from ehlwave.contact.conditions import Conditions
from ehlwave.duals import np
from ehlwave.laws.atlas.chart import Chart
from ehlwave.laws.atlas.coordinates import Floats, columns
from ehlwave.laws.atlas.line import LineShape
from ehlwave.laws.atlas.line_rolling import rolling_line_chart
from ehlwave.laws.atlas.line_sliding import line_conditions_of
from ehlwave.laws.atlas.ranges import LINE_RANGES
from ehlwave.laws.atlas.shape import Seen
from ehlwave.laws.atlas.sliding_shape import SlidingShape


class LineSlidingShape(SlidingShape, LineShape):
    """Responses of line contacts that slide: the law of the two waves with the rolling line's."""

    WAVE_AND_X = (1, 0)
    CONDITIONS_OF = staticmethod(line_conditions_of)
    """Conversion of keys to conditions."""

    @classmethod
    def of_keys(cls, keys: Mapping[str, ArrayLike]) -> "LineSlidingShape":
        """Return the shape of contacts: columns as for :meth:`SlidingShape.of_keys`."""
        shape = cls(*map(np.atleast_1d, columns(keys, list(LINE_RANGES)[:2])))
        shape._take(cls.CONDITIONS_OF(keys), keys)
        return shape

    def seen(self, wavelength_over_a: ArrayLike, angle_deg: ArrayLike) -> Seen:
        """Return waves as :meth:`SlidingShape.seen`; all are transverse, angles are 0."""
        return super().seen(wavelength_over_a, np.zeros(np.shape(wavelength_over_a)))

    def _lengths(self) -> tuple[Floats, ...]:
        """Return the coordinates of a contact by L alone: a line has no ellipticity."""
        return (np.log(self.l),)

    @staticmethod
    def _rolls(contact: Conditions) -> Chart:
        """Return the chart of a contact in pure rolling."""
        return rolling_line_chart(contact)
