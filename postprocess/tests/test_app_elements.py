"""Tabs of the page for bearings, gears and cams: fields become elements, and reports come back."""

import asyncio

import pytest

pytest.importorskip("panel", reason="the page needs Panel: pip install './postprocess[app]'")

from ehlwave.app.element_quantities import TABS
from ehlwave.app.element_tab import ElementTab
from ehlwave.app.work import Pools
from ehlwave.elements.document import CALLS


@pytest.mark.parametrize(
    ("tab", "element"), [(tab, element) for tab, every in TABS.items() for element in every]
)
def test_examples_of_the_fields_answer(tab: str, element: str) -> None:
    pools = Pools(1)
    try:
        form = ElementTab(tab, pools)
        form.element.value = element
        assert element in CALLS
        assert "<svg" in form.drawing.object
        asyncio.run(form._compute(None))
        assert form.first.object == ""
        assert "Worst places" in form.report.object
        assert "heat=" not in form.report.object
        assert form._file().getvalue().startswith("<!doctype html>")
        form.fields[element][0][0].text.value = "-1"
        asyncio.run(form._compute(None))
        assert "must be" in form.first.object
        assert "Field:" in form.first.object
        assert form.report.object == ""
    finally:
        pools.close()
