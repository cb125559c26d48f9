"""The contact of the page, entered in one of several ways."""

from typing import Any

import panel as pn

from ehlwave.app import quantities as q
from ehlwave.app.contacts import Given
from ehlwave.app.oil_form import OilForm
from ehlwave.app.widgets import (
    HALF,
    NumberField,
    column,
    given_by,
    in_rows,
    section,
    select,
    title,
    widgets_of,
)
from ehlwave.contact.materials import MATERIALS

BODIES, MOES = "Two bodies", "M, L, D"
KINDS = {"Reduced": q.REDUCED, "Line": q.LINE, MOES: q.MOES}
OWN = "own values"
ISOTHERMAL, WITH_HEAT = "isothermal", "with heat"


class BodyForm:
    """One of the two bodies."""

    def __init__(self, name: str, radius: str) -> None:
        """Make the fields."""
        self.material = select("Material", [*MATERIALS, OWN])
        self.numbers = [NumberField(one) for one in q.body(radius)]
        self.speed = NumberField(q.SURFACE_SPEED)
        self.material.param.watch(self._show, "value")
        self._show()
        views = [title(name), self.material]
        views += [one.view for one in (*self.numbers, self.speed)]
        self.view = in_rows(views, 1, styles=HALF)

    def _show(self, *_: Any) -> None:  # noqa: ANN401
        for one in self.numbers[2:]:
            one.view.visible = self.material.value == OWN

    def given(self) -> dict[str, Any]:
        """Return the arguments of a body."""
        if self.material.value == OWN:
            return given_by(self.numbers)
        return given_by(self.numbers[:2]) | {"material": self.material.value}

    @property
    def widgets(self) -> list[Any]:
        """Return the fields to edit."""
        return [self.material, *widgets_of([*self.numbers, self.speed])]


class ContactForm:
    """A contact, entered in one of several ways, and its oil."""

    def __init__(self) -> None:
        """Make the fields."""
        self.kind = pn.widgets.RadioButtonGroup(
            name="Contact entered by",
            options=[BODIES, *KINDS],
            value=BODIES,
            sizing_mode="stretch_width",
            button_type="default",
            margin=(6, 4),
        )
        self.bodies = [BodyForm("Body 1, the rough one", "12.7"), BodyForm("Body 2", "")]
        self.loads = [NumberField(one) for one in (q.LOAD, q.LINE_LENGTH, q.STARVED)]
        self.heat = select("Film and friction", [ISOTHERMAL, WITH_HEAT], q.HEAT_HELP)
        self.fields = {kind: [NumberField(one) for one in each] for kind, each in KINDS.items()}
        self.views = {kind: in_rows(f.view for f in each) for kind, each in self.fields.items()}
        both = in_rows(body.view for body in self.bodies)
        self.views[BODIES] = column(both, in_rows([*(one.view for one in self.loads), self.heat]))
        self.oil = OilForm()
        self.kind.param.watch(self._show, "value")
        self._show()
        self.view = column(section("Contact", self.kind, *self.views.values()), self.oil.view)

    def _show(self, *_: Any) -> None:  # noqa: ANN401
        for kind, view in self.views.items():
            view.visible = kind == self.kind.value
        self.oil.has_viscosity = self.kind.value != MOES
        self.oil.show()

    def shown(self) -> list[NumberField]:
        """Return the fields that count."""
        if self.kind.value == BODIES:
            each = [*self.bodies[0].numbers, self.bodies[0].speed, *self.loads]
        else:
            each = self.fields[self.kind.value]
        return [*each, *self.oil.shown()]

    def given(self) -> Given:
        """Return the input, SI."""
        found = self.oil.given()
        if self.kind.value != BODIES:
            keys = given_by(self.fields[self.kind.value])
            return Given(**found | {"keys": keys | found["keys"]})
        speeds = [body.speed.given().get("speeds_m_per_s", "") for body in self.bodies]
        keys = given_by(self.loads) | {"speeds_m_per_s": tuple(speeds)} | found["keys"]
        keys |= {"heat": True} if self.heat.value == WITH_HEAT else {}
        first, second = (body.given() for body in self.bodies)
        return Given(**found | {"keys": keys, "bodies": (first, second)})

    @property
    def widgets(self) -> list[Any]:
        """Return the fields to edit."""
        every = [*self.loads]
        for each in self.fields.values():
            every += each
        own = [widget for one in (*self.bodies, self.oil) for widget in one.widgets]
        return [self.kind, self.heat, *own, *widgets_of(every)]
