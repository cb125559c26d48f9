"""Computed answers, in the form of the list of laws."""

from typing import Protocol

from ehlwave.contact.conditions import Conditions
from ehlwave.contact.heat_data import Heat
from ehlwave.errors import ProgramError
from ehlwave.laws import computed_film as films
from ehlwave.laws import computed_transfer as transfers
from ehlwave.laws.answers import Film
from ehlwave.programs.programs import find_program


class Asked(Protocol):
    """The parts of a question that computed answers depend on."""

    @property
    def conditions(self) -> Conditions:
        """Conditions of the contact."""

    @property
    def heat(self) -> Heat | None:
        """Heat data; None: isothermal."""


def has_programs() -> bool:
    """Return whether both programs are installed."""
    try:
        return bool(find_program("ehlwave-case") and find_program("ehlwave-sweep"))
    except ProgramError:
        return False


def computed_film(asked: Asked) -> Film:
    """Return films and friction; see :func:`ehlwave.laws.computed_film.computed_film`."""
    return films.computed_film(asked.conditions, asked.heat)


class ComputedTransfer(transfers.ComputedTransfer):
    """Transfer of computed waves; see :class:`ehlwave.laws.computed_transfer.ComputedTransfer`."""

    def __init__(self, asked: Asked) -> None:
        """Take the contact; waves are computed when they are asked for."""
        super().__init__(asked.conditions, asked.heat)
