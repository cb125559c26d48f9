"""Settings of the manual; `scripts/manual` builds it. Its pages are the READMEs of the folders and those beside this file."""

import os
import re
import sys
from pathlib import Path

root = Path(__file__).parents[2]
sys.path.insert(0, str(root / "postprocess" / "src"))

project = "ehlwave"
author = "the developers of ehlwave"
release = os.environ.get("EHLWAVE_VERSION", "")
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
    "postprocess/examples/*.md",
    "postprocess/manual/**",
    "build/manual/pages/**",
]
exclude_patterns = ["build/[!m]*", "build/manual/html", "**/tests/**", "**/.*", "**/CMakeFiles/**"]

myst_enable_extensions = ["amsmath", "colon_fence", "dollarmath"]
myst_heading_anchors = 4
nb_execution_mode = os.environ.get("EHLWAVE_MANUAL_EXECUTION", "force")
nb_execution_raise_on_error = True
nb_execution_timeout = 600
nb_execution_in_temp = True

numpydoc_show_class_members = False
autodoc_typehints = "none"

html_theme = "furo"
html_title = "ehlwave"
html_copy_source = False
html_show_sourcelink = False


def link_folders(app, document, source):
    """Let links to folders lead to their READMEs, or to their names where there is none."""
    here = (root / document).parent

    def target(match):
        text, place = match[1], match[2]
        if "://" in place or not (here / place).is_dir():
            return match[0]
        return f"[{text}]({place.rstrip('/')}/README.md)" if (here / place / "README.md").exists() else text

    source[0] = re.sub(r"\[([^\]]*)\]\(([^)#\s]+)\)", target, source[0])


def setup(app):
    """Register the above."""
    app.connect("source-read", link_folders)
