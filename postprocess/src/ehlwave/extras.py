"""Metadata of the installation: the version, and packages that belong to an extra."""

import re
import sys
import sysconfig
from importlib import import_module
from pathlib import Path
from types import ModuleType

EXTRAS = {
    "matplotlib": "figures",
    "lmfit": "figures",
    "SurfaceTopography": "instruments",
    "panel": "app",
    "bokeh": "app",
    "pint": "units",
    "pyarrow": "parquet",
    "tqdm": "notebook",
    "ipywidgets": "notebook",
}
"""Extra of each package, by the name that is imported."""

CORE = ("numpy", "scipy", "h5py", "xarray", "h5netcdf", "pandas", "tomli")
"""Packages that are always needed. They are missing where the source is used without pip."""
PROJECT = Path(__file__).parents[2] / "pyproject.toml"
"""There in a repository only: an installation has its own advice on missing packages."""


def install(extra: str = "") -> str:
    """Return the command that installs the package, with an extra, from the repository's folder.

    Where the system manages the packages of this Python (PEP 668), a virtual environment comes
    first.
    """
    command = f"pip install './postprocess[{extra}]'" if extra else "pip install ./postprocess"
    if is_externally_managed():
        return f"python3 -m venv venv && . venv/bin/activate && {command}"
    return command


def is_externally_managed() -> bool:
    """Return whether pip refuses to install into this Python (PEP 668)."""
    if sys.prefix != sys.base_prefix:
        return False
    return Path(sysconfig.get_path("stdlib"), "EXTERNALLY-MANAGED").exists()


def advice(error: ModuleNotFoundError) -> str | None:
    """Return the command that installs a missing package; nothing if it is not ours."""
    package = (error.name or "").split(".")[0]
    if package not in (*EXTRAS, *(CORE if PROJECT.exists() else ())):
        return None
    return f"{package} is missing: {install(EXTRAS.get(package, ''))}"


def load(module: str) -> ModuleType:
    """Import a module that needs an extra.

    Raises ModuleNotFoundError if a package is missing; the message names the extra that has it.
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if text := advice(error):
            raise ModuleNotFoundError(text, name=error.name) from None
        raise


def version() -> str:
    """Return the version by the metadata of the installation, or by the source on the path."""
    from importlib import metadata

    try:
        return metadata.version("ehlwave")
    except metadata.PackageNotFoundError:
        project = Path(__file__).parents[2] / "pyproject.toml"
        text = project.read_text(encoding="utf-8") if project.is_file() else ""
        found = re.search(r'^version = "([^"]*)"', text, re.MULTILINE)
        return found[1] if found else "0+unknown"
