"""A key of input files: its kind, its bounds or choices, and the check of a value.

The check is the one of the programs (``src/input/key_bounds.f90``). A differential test holds both
to the same verdicts and values.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

from ehlwave.inputs.namelist_tokens import shown
from ehlwave.inputs.namelist_values import Value, real, truth, whole, word

_READINGS: dict[str, Callable[[Value], Any]] = {"number": real, "whole": whole, "truth": truth}


class Key(NamedTuple):
    """A row of the key table of the programs; None: no bound."""

    group: str
    kind: str
    """``number``, ``whole``, ``truth`` or ``word``."""
    unit: str = "1"
    above: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    short: str = ""
    """Name that its group takes, too: ``orientation`` in ``&waviness2``."""

    def read(self, value: Value) -> Any:  # noqa: ANN401 - number, text or truth
        """Return a value of this key.

        Raises ValueError with the change needed for values of another kind or out of bounds.
        """
        if self.kind == "word":
            return self._word(value)
        found = _READINGS[self.kind](value)
        if self.kind != "truth" and not self._holds(found):
            unit = "" if self.unit == "1" else f"in {self.unit}, "
            text = f"{shown(value.text)} is out of range: write a value {unit}{self._bounds()}"
            raise ValueError(text)
        return found

    def _word(self, value: Value) -> str:
        found = word(value)
        if self.choices:
            chosen = value.text.rstrip(b" ").lower()
            if chosen not in [choice.encode() for choice in self.choices]:
                raise ValueError(
                    f"'{shown(chosen)}' is not one of the choices: write one of "
                    + ", ".join(f"'{choice}'" for choice in self.choices)
                )
            return chosen.decode()
        length = len(value.text)
        if self.minimum is not None and length < self.minimum:
            raise ValueError(f"text of {length} characters: write at least {self.minimum:g}")
        if self.maximum is not None and length > self.maximum:
            raise ValueError(f"text of {length} characters: write at most {self.maximum:g}")
        return found.rstrip(" ")

    def _holds(self, number: float) -> bool:
        return (
            (self.above is None or number > self.above)
            and (self.minimum is None or number >= self.minimum)
            and (self.maximum is None or number <= self.maximum)
        )

    def _bounds(self) -> str:
        bounds = {"above": self.above, "at least": self.minimum, "at most": self.maximum}
        words = [f"{name} {_short(one)}" for name, one in bounds.items() if one is not None]
        return " and ".join(words)


def _short(number: float) -> str:
    """Return a number as the programs print it, ``1e-6`` for 1e-06."""
    return f"{number:.15g}".replace("e-0", "e-").replace("e+0", "e+")
