"""The version of the installed package."""


def version() -> str:
    """Return the version by the metadata of the installation."""
    from importlib import metadata

    try:
        return metadata.version("ehlwave")
    except metadata.PackageNotFoundError:
        return "0+unknown"  # sources on the path, not installed
