"""Oil parameters that measured films, frictions and amplitude ratios imply."""

from ehlwave.identify.figure import identification_figure
from ehlwave.identify.fit import identify
from ehlwave.identify.identified import Identified, Parameter
from ehlwave.identify.measurements import Measurements, read_measurements

__all__ = [
    "Identified",
    "Measurements",
    "Parameter",
    "identification_figure",
    "identify",
    "read_measurements",
]
