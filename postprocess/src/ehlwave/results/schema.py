"""Names in the results files of ``ehlwave-sweep``, format version 1."""

FORMAT_NAME = "ehlwave-results"
FORMAT_VERSION = 1

DIMENSION = "case"
"""The only dimension: one entry per case of the sweep."""

REQUIRED_COLUMNS = (
    "case_id",
    "load_parameter_m",
    "lubricant_parameter_l",
    "radius_ratio_d",
    "slip_parameter",
    "orientation",
    "wavelength_over_a",
    "wavelength_x_over_a",
    "wavelength_y_over_a",
    "v",
    "v2",
    "f_r",
    "status",
    "is_resolved",
    "amplitude_ratio",
    "amplitude_ratio_fit",
)
"""Datasets this package computes with. Others are read, kept and exported when they are there."""

PROVENANCE_ATTRIBUTES = ("program_version", "git_revision", "compiler")
"""Kept with every case, to identify the origin of results: a column of this name, else the root
attribute.
"""

ORIENTATIONS = ("transverse", "isotropic", "longitudinal")
"""The orientations of the paper, in the order of the panels of its Figures 1 and 2."""

EDGES = ("flooded", "truncated")
"""Pressures at the edges of the domain, the column ``edges``."""

EDGES_BEFORE = "truncated"
"""Values of cases from before there was such a column."""

SMOOTH = "none"
"""The ``orientation`` of a case without waviness."""

CONVERGED = "converged"
UNRESOLVED = "unresolved"
INACCURATE = "inaccurate"
"""Solved, but with an estimated error above the accuracy that was asked for."""

SETTLED = (CONVERGED, UNRESOLVED)
"""Statuses of results whose equations are solved, and that reach any requested accuracy."""

PENDING = "pending"
FAILED = ("stalled", "diverged", "not_finite", "over_budget", "crashed")
STATUSES = (CONVERGED, UNRESOLVED, INACCURATE, *FAILED, PENDING)
