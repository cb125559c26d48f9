"""The kinds of atlases that there are."""

from ehlwave.atlas.kind import FILMS, Kind
from ehlwave.atlas.line import LineShape, line_coordinates, line_references
from ehlwave.atlas.ranges import LINE_RANGES, SLIDING_RANGES
from ehlwave.atlas.rolling import ROLLING
from ehlwave.atlas.sliding import sliding_coordinates, sliding_references, sliding_state
from ehlwave.atlas.sliding_shape import SlidingShape

SLIDING = Kind(
    "sliding",
    SLIDING_RANGES,
    sliding_coordinates,
    SlidingShape.of_keys,
    (*FILMS, "friction_ratio", "pressure_ratio"),
    sliding_references,
    sliding_state,
)
LINE = Kind("line", LINE_RANGES, line_coordinates, LineShape.of_keys, FILMS, line_references)
KINDS = {kind.name: kind for kind in (ROLLING, SLIDING, LINE)}
