"""The kinds of atlases that there are."""

from ehlwave.atlas.kind import FILMS, Kind
from ehlwave.atlas.line import beyond_sliding_limits, line_coordinates
from ehlwave.atlas.line_newtonian import (
    LINE_NEWTONIAN_RANGES,
    LineNewtonianShape,
    line_newtonian_references,
)
from ehlwave.atlas.line_rolling import LINE
from ehlwave.atlas.line_sliding import (
    LINE_SLIDING_RANGES,
    line_sliding_coordinates,
    line_sliding_references,
    line_sliding_state,
)
from ehlwave.atlas.line_sliding_shape import LineSlidingShape
from ehlwave.atlas.ranges import SLIDING_RANGES
from ehlwave.atlas.rolling import ROLLING, WIDE
from ehlwave.atlas.sliding import sliding_coordinates, sliding_references, sliding_state
from ehlwave.atlas.sliding_shape import SlidingShape
from ehlwave.atlas.sliding_wide import SLIDING_WIDE

SLIDING = Kind(
    "sliding",
    SLIDING_RANGES,
    sliding_coordinates,
    SlidingShape.of_keys,
    (*FILMS, "friction_ratio", "pressure_ratio"),
    sliding_references,
    sliding_state,
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
