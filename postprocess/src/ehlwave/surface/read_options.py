"""Options for reading measured surfaces."""

from dataclasses import dataclass

from ehlwave.choices import AXES, DECIMALS, Axis, Decimal, chosen


@dataclass(frozen=True)
class ReadOptions:
    """Units and steps that a file does not state.

    Attributes
    ----------
    length_unit, height_unit : str or None
        Units of positions and steps, and of heights, where the file states none; a unit that
        contradicts the file is refused. With a `step`, ``length_unit`` is the unit of the step.
    step, step_across : float or None
        Sampling steps along the first and second axis of the file, in ``length_unit``, for files
        without positions; ``step_across`` is ``step`` if absent.
    rolling_axis : "x" or "y"
        Of the surface in the file. The rows of a map in a file are lines of constant y: ``x`` runs
        along a row. A trace along rolling is ``x``, a trace across it ``y``.
    fill_missing : bool
        Replace missing heights, and heights far outside all others, by their nearest neighbours:
        at most a tenth of them. The notes of the surface state their number.
    decimal : "point", "comma" or None
        Decimal mark of a text file, where the file does not decide it.
    channel : str or None
        The channel, or the heading of the column, of heights, where the file has several.
    """

    length_unit: str | None = None
    height_unit: str | None = None
    step: float | None = None
    step_across: float | None = None
    rolling_axis: Axis = "x"
    fill_missing: bool = False
    decimal: Decimal | None = None
    channel: str | None = None

    def __post_init__(self) -> None:
        """Check the words."""
        chosen(self.rolling_axis, "rolling_axis", AXES)
        if self.decimal is not None:
            chosen(self.decimal, "decimal", DECIMALS)
