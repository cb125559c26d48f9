"""The kinds of atlases that there are."""

from ehlwave.laws.atlas.kind import FILMS, Kind
from ehlwave.laws.atlas.line import beyond_sliding_limits, line_coordinates
from ehlwave.laws.atlas.line_newtonian import (
    LINE_NEWTONIAN_RANGES,
    LineNewtonianShape,
    line_newtonian_references,
)
from ehlwave.laws.atlas.line_rolling import LINE
from ehlwave.laws.atlas.line_sliding import (
    LINE_SLIDING_RANGES,
    line_sliding_coordinates,
    line_sliding_references,
    line_sliding_state,
)
from ehlwave.laws.atlas.line_sliding_shape import LineSlidingShape
from ehlwave.laws.atlas.ranges import SLIDING_RANGES
from ehlwave.laws.atlas.rolling import ROLLING, WIDE
from ehlwave.laws.atlas.sliding import (
    beyond_thinning,
    sliding_coordinates,
    sliding_references,
    sliding_state,
)
from ehlwave.laws.atlas.sliding_shape import SlidingShape
from ehlwave.laws.atlas.sliding_wide import SLIDING_WIDE

SLIDING = Kind(
    "sliding",
    SLIDING_RANGES,
    sliding_coordinates,
    SlidingShape.of_keys,
    (*FILMS, "friction_ratio", "pressure_ratio"),
    sliding_references,
    sliding_state,
    beyond_thinning,
)
LINE_SLIDING = Kind(
    "line_sliding",
    LINE_SLIDING_RANGES,
    line_sliding_coordinates,
    LineSlidingShape.of_keys,
    (*FILMS, "friction_ratio", "pressure_ratio"),
    line_sliding_references,
    line_sliding_state,
    beyond_sliding_limits,
)
LINE_NEWTONIAN = Kind(
    "line_newtonian",
    LINE_NEWTONIAN_RANGES,
    line_coordinates,
    LineNewtonianShape.of_keys,
    (*FILMS, "pressure_ratio"),
    line_newtonian_references,
    line_sliding_state,
    beyond_sliding_limits,
)
_ALL = (ROLLING, WIDE, SLIDING, SLIDING_WIDE, LINE, LINE_SLIDING, LINE_NEWTONIAN)
KINDS = {kind.name: kind for kind in _ALL}
