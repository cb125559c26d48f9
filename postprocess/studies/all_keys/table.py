"""The table of keys, as the program prints it."""

import re

from studies import programs


def key_groups() -> dict[str, str]:
    """Return the group of every key."""
    found, group = {}, ""
    for line in programs.run("case", "--keys").stdout.splitlines():
        if match := re.match(r"&(\w+)", line):
            group = match[1]
        elif match := re.match(r"  (\w+) \(default", line):
            found[match[1]] = group
    return found
