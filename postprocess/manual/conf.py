"""Settings of the manual, which `scripts/manual` builds.

Its pages are the READMEs of the folders, the pages beside this file and those that `pages.py`
writes.
"""

import os
import re
import sys
from pathlib import Path
from typing import Any

root = Path(__file__).parents[2]
sys.path.insert(0, str(root / "postprocess" / "src"))

project = "ehlwave"
author = "the developers of ehlwave"
root_doc = "postprocess/manual/index"
extensions = [
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx_design",
    "sphinx-mathjax-offline",
]

# The source is the whole repository, so that links between READMEs hold as they are.
include_patterns = [
    "README.md",
    "**/README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "src/theory.md",
    "src/theory/*.md",
    "inputs/*.md",
    "inputs/keys/*.md",
    "postprocess/*.md",
    "postprocess/examples/*.md",
    "postprocess/manual/**",
    "build/manual/pages/**",
]
exclude_patterns = [
    "build/[!m]*",
    "build/manual/html",
    "**/tests/**",
    ".*",
    "**/.*",
    "**/CMakeFiles/**",
]

myst_enable_extensions = ["amsmath", "colon_fence", "dollarmath"]
myst_heading_anchors = 4
nb_execution_mode = "force"  # runs all pages that are read; scripts/manual limits them
nb_execution_raise_on_error = True
nb_execution_timeout = 600
nb_execution_in_temp = True
nb_merge_streams = True
# A tutorial with a warning needs a fix.
nb_output_stderr = "warn"
os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")
# Tutorials start programs by their names, in the folder of the repository.
os.environ["EHLWAVE_ROOT"] = str(root)
if "EHLWAVE_PROGRAMS" in os.environ:
    os.environ["PATH"] = f"{os.environ['EHLWAVE_PROGRAMS']}:{os.environ['PATH']}"

numpydoc_show_class_members = False
numpydoc_validation_checks = {"EX01", "PR01", "PR02"}
autodoc_typehints = "none"

html_theme = "furo"
html_title = "ehlwave"
html_copy_source = False
html_show_copyright = False
html_show_sourcelink = False
html_static_path = ["static"]
html_css_files = ["manual.css"]


def link_folders(_app: Any, document: str, source: list[str]) -> None:  # noqa: ANN401
    """Let links to folders lead to their READMEs, or to their names where there is none."""
    here = (root / document).parent

    def target(match: re.Match[str]) -> str:
        text, place = match[1], match[2]
        folder = root / place[1:] if place.startswith("/") else here / place
        if "://" in place or not folder.is_dir():
            return match[0]
        if not (folder / "README.md").exists():
            return text
        return f"[{text}]({place.rstrip('/')}/README.md)"

    source[0] = re.sub(r"\[([^\]]*)\]\(([^)#\s]+)\)", target, source[0])


def setup(app: Any) -> None:  # noqa: ANN401
    """Register the above."""
    app.connect("source-read", link_folders)
