"""The oil of the page: its numbers, a data sheet, or a name."""

from typing import Any

from ehlwave.app import quantities as q
from ehlwave.app.widgets import NumberField, given_by, in_rows, section, select, widgets_of
from ehlwave.contact.data_sheet import DENSITIES
from ehlwave.contact.measured_oils import MEASURED

NUMBERS, BY_GRADE, BY_NAME = "Viscosity and alpha", "Grade or data sheet", "Measured oil"


class OilForm:
    """An oil: its numbers, a data sheet, or a name."""

    def __init__(self) -> None:
        """Make the fields."""
        self.kind = select("Oil by", [NUMBERS, BY_GRADE, BY_NAME])
        self.viscosity = NumberField(q.VISCOSITY)
        self.numbers = [NumberField(one) for one in q.OIL]
        self.sheet = [NumberField(one) for one in q.GRADE]
        self.base = select("Base oil", list(DENSITIES))
        self.name = select("Name", list(MEASURED))
        self.temperature = NumberField(q.TEMPERATURE)
        self.flow = select("Flow law", list(q.FLOWS))
        self.flows = {law: [NumberField(one) for one in each] for law, each in q.FLOWS.items()}
        self.parts = {
            NUMBERS: in_rows([self.viscosity.view, *(one.view for one in self.numbers)]),
            BY_GRADE: in_rows([*(one.view for one in self.sheet), self.base]),
            BY_NAME: in_rows([self.name, self.temperature.view]),
        }
        self.laws = {law: in_rows(f.view for f in each) for law, each in self.flows.items()}
        self.has_viscosity = True
        for one in (self.kind, self.flow):
            one.param.watch(self.show, "value")
        self.show()
        head = in_rows([self.kind, self.flow])
        self.view = section("Oil", head, *self.laws.values(), *self.parts.values())

    def show(self, *_: Any) -> None:  # noqa: ANN401
        """Show the fields that count; M, L and D leave no choice."""
        self.kind.disabled = not self.has_viscosity
        self.viscosity.view.visible = self.has_viscosity
        for kind, view in self.parts.items():
            view.visible = kind == self.chosen
        for law, view in self.laws.items():
            view.visible = law == self.flow.value

    @property
    def chosen(self) -> str:
        """Return how the oil is entered."""
        return self.kind.value if self.has_viscosity else NUMBERS

    def shown(self) -> list[NumberField]:
        """Return the fields that count."""
        own = [self.viscosity] if self.has_viscosity else []
        parts = {NUMBERS: [*own, *self.numbers], BY_GRADE: self.sheet, BY_NAME: [self.temperature]}
        return [*parts[self.chosen], *self.flows[self.flow.value]]

    def given(self) -> dict[str, Any]:
        """Return keys, oil and maker of the input."""
        law = given_by(self.flows[self.flow.value])
        found = given_by([one for one in self.shown() if one.key not in law])
        if self.chosen == NUMBERS:
            return {"keys": found | law}
        if self.chosen == BY_GRADE:
            return {"keys": law, "oil": found | {"kind": self.base.value}, "maker": "from_grade"}
        return {"keys": law, "oil": {"name": self.name.value, **found}, "maker": "named"}

    @property
    def widgets(self) -> list[Any]:
        """Return the fields to edit."""
        every = [self.viscosity, *self.numbers, *self.sheet, self.temperature]
        for each in self.flows.values():
            every += each
        return [self.kind, self.base, self.name, self.flow, *widgets_of(every)]
