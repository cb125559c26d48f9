"""Metadata of the installation: the version, and packages that belong to an extra."""

from importlib import import_module
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


def install(extra: str) -> str:
    """Return the command that installs an extra, from the folder of the repository."""
    return f"pip install './postprocess[{extra}]'"


def advice(error: ModuleNotFoundError) -> str | None:
    """Return the command that installs a missing package; nothing if it is of no extra."""
    package = (error.name or "").split(".")[0]
    if package not in EXTRAS:
        return None
    return f"{package} is missing: {install(EXTRAS[package])}"


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
    """Return the version by the metadata of the installation."""
    from importlib import metadata

    try:
        return metadata.version("ehlwave")
    except metadata.PackageNotFoundError:
        return "0+unknown"  # sources on the path, not installed
