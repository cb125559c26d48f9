"""From a stylus trace to its shape inside the contact.

    python deformed_trace.py [FOLDER]

The contact comes from the experiment of Venner, Kaneta and Lubrecht (2000); the trace is synthetic,
like their Figure 4. Prints the report; writes figures and data into FOLDER, if given.
"""

import sys
from pathlib import Path

import numpy as np

from ehlwave import Contact, write_figure
from ehlwave.surface import (
    deformed_figure,
    report_text,
    spectrum_figure,
    trace_surface,
    write_results,
)

# Dimensional data, SI units; keys as in input files of ehlwave-case.
contact = Contact(
    radius_x_m=12.52e-3,
    radius_y_m=12.52e-3,
    reduced_modulus_pa=1.17e11,
    load_n=39.2,
    mean_speed_m_per_s=0.096,
    viscosity_pa_s=1.22,
    pressure_viscosity_per_pa=2.25e-8,
)

# A measured trace would come from read_surface("trace.csv"). Heights in m, peaks positive.
position = np.arange(0, 1.2e-3, 0.5e-6)
height = 0.14e-6 * np.cos(2 * np.pi * position / 60e-6)  # the sputtered pattern
height += 0.02e-6 * np.cos(2 * np.pi * position / 17e-6 + 1)  # finer marks
height += 0.10e-6 * position / position[-1]  # the specimen was tilted
trace = trace_surface(height, step_m=0.5e-6, axis="x", name="synthetic trace")

# The tilt is removed, the ends are mirrored, each harmonic has its response from the atlas.
result = contact.deform(trace, form="plane", ends="mirror")
print(report_text(result))

if len(sys.argv) > 1:
    folder = Path(sys.argv[1])
    written = write_results(result, folder)
    written += write_figure(deformed_figure(result), folder, "deformed")
    written += write_figure(spectrum_figure(result), folder, "spectrum")
    print("\n".join(str(path) for path in written))
