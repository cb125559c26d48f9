"""The table of keys, as the program lists it."""

from studies import programs


def key_groups() -> dict[str, str]:
    """Return the group of every key."""
    keys = programs.last_line(programs.run("case", "--keys", "--json"))["keys"]
    return {key["name"]: key["group"] for key in keys}
