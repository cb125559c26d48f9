"""The experiment of Venner, Kaneta and Lubrecht (2000), section 4.

``python -m studies.experiment`` runs it; :func:`section` is its part of the report.
"""

from studies.experiment.report import FOLDER, TRACE_FILE, section

__all__ = ["FOLDER", "TRACE_FILE", "section"]
