"""The tabs of the page: a contact, a bearing, a gear, a cam."""

from typing import Any

import panel as pn

from ehlwave.app.element_quantities import TABS
from ehlwave.app.element_tab import ElementTab
from ehlwave.app.widgets import column
from ehlwave.app.work import Pools

CONTACT = "Contact"


def with_elements(inputs: Any, answers: Any, pools: Pools) -> tuple[Any, Any]:  # noqa: ANN401
    """Return the inputs below a choice of tabs, and the answers of all of them.

    A tab is made when it is chosen for the first time.

    Parameters
    ----------
    inputs, answers : object
        Tab of a contact.
    pools : Pools
        Threads of the server.
    """
    chooser = pn.widgets.RadioButtonGroup(
        name="Answer for",
        options=[CONTACT, *TABS],
        value=CONTACT,
        sizing_mode="stretch_width",
        button_type="default",
        margin=(2, 4, 8, 4),
    )
    tabs: dict[str, tuple[Any, Any]] = {CONTACT: (inputs, answers)}
    left, right = column(inputs), column(answers)

    def show(*_: Any) -> None:  # noqa: ANN401
        if chooser.value not in tabs:
            tab = ElementTab(chooser.value, pools)
            tabs[chooser.value] = (tab.inputs, tab.answers)
        left[:], right[:] = [tabs[chooser.value][0]], [tabs[chooser.value][1]]

    chooser.param.watch(show, "value")
    return column(chooser, left), right
