"""The errors a user is meant to see."""


class ResultsError(Exception):
    """A results file, or what it holds, cannot be used.

    The message names the file and says what is wrong with it; the command prints it without a
    traceback.
    """


class SurfaceError(ResultsError):
    """A measured surface, operating conditions or a harmonic table cannot be used.

    The message names the file or key, its value, and what to change.
    """


class RangeError(ResultsError, ValueError):
    """What is asked for lies outside what was computed; nothing is extrapolated.

    The message names the quantity, its value and the range.
    """


class ProgramError(ResultsError):
    """A program is not there, or refused its input; the message has what it said."""


class StressError(ResultsError, ValueError):
    """Loads, depths or an oil film cannot be turned into stresses below the surface.

    The message names the argument or file, its value, and what to change.
    """
