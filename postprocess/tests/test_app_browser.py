"""The page in a browser without a head, used as users do."""

import asyncio
import json
import os
import subprocess
import sys
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from app_traces import Example, examples

pytest.importorskip("panel", reason="the page needs Panel: pip install './postprocess[app]'")

import chromium
from app_server import running
from chromium import Chromium, Tab, until
from contact import BALL
from long_tests import IS_LONG

import ehlwave
from ehlwave.cli import main

if chromium.PROGRAM is None:
    pytest.skip("no chromium on PATH (Debian: chromium)", allow_module_level=True)

Use = Callable[[Chromium, list[str]], Awaitable[None]]
Browse = Callable[[Use], list[str]]
"""Use a browser and its proxy; return the list of requests, filled as they come."""

SESSIONS = 20 if IS_LONG else 2
EXAMPLES = range(4) if IS_LONG else (1,)
FITTED = 1
"""Example whose page is shown in windows of several widths, too."""


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with running(tmp_path_factory.mktemp("app")) as found:
        yield found


@pytest.fixture(scope="module")
def in_browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browse]:
    """Use a browser whose way to other hosts is a proxy that refuses; return the requests."""
    loop = asyncio.new_event_loop()
    asked: list[str] = []

    async def refuse(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        line = await reader.readline()
        asked.append(line.decode("latin-1").strip())
        writer.write(b"HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\nConnection: close\r\n\r\n")
        writer.close()

    proxy = loop.run_until_complete(asyncio.start_server(refuse, "127.0.0.1", 0))
    through = f"--proxy-server=http://127.0.0.1:{proxy.sockets[0].getsockname()[1]}"
    browser = Chromium(tmp_path_factory.mktemp("chromium") / "browser", through)
    loop.run_until_complete(browser.__aenter__())

    def run(use: Use) -> list[str]:
        asked.clear()
        try:
            loop.run_until_complete(asyncio.wait_for(use(browser, asked), 900))
        finally:
            loop.run_until_complete(browser.close_tabs())
        return asked

    yield run
    loop.run_until_complete(browser.__aexit__())
    proxy.close()
    loop.close()


def foreign(tab: Tab, address: str) -> list[str]:
    """Return the requests of a tab to other hosts, and for data outside the page."""
    socket = address.replace("http", "ws", 1)
    starts = (f"{address}/", f"{socket}/", "data:", f"blob:{address}/", "about:")
    assert len(tab.requests) > 5
    return [one for one in tab.requests if not one.startswith(starts)]


async def entered(tab: Tab, example: Example) -> None:
    """Enter an example into the page."""
    await tab.click(example.kind)
    await until(lambda: tab.shows(next(iter(example.typed))), "its fields")
    await tab.click("More about the surface")
    await until(lambda: tab.shows("Judged by"), "more fields")
    for label, text in example.chosen.items():
        await tab.choose(label, text)
    for label, text in example.typed.items():
        await tab.fill(label, text)
    await tab.give_file(example.path)
    await until(lambda: tab.has_text("Upload complete"), "the file is there")


async def gone(tab: Tab, label: str) -> None:
    """Wait until no field with this label is seen."""

    async def hidden() -> bool:
        return not await tab.shows(label)

    await until(hidden, f"{label} is hidden")


async def computed(tab: Tab) -> None:
    await tab.click("Compute")
    await until(lambda: tab.shows_text("Save JSON"), "the answer")


async def fits(tab: Tab) -> None:
    """Check that the page is as wide as its window."""
    for width in (400, 800, 1920):
        await tab.size(width, 900)
        for kind in ("Two bodies", "Line", "M, L, D", "Reduced"):
            await tab.click(kind)
            await asyncio.sleep(0.3)
            wide = await tab.script(
                "document.documentElement.scrollWidth - document.documentElement.clientWidth"
            )
            assert wide <= 0, (width, kind)


def in_any_order(report: dict[str, Any]) -> dict[str, Any]:
    """Return a report whose conditions are independent of the order of keys."""
    conditions = dict(report["conditions"])
    conditions["given"] = sorted(conditions.get("given", []))
    return report | {"conditions": conditions}


@pytest.mark.parametrize("number", EXAMPLES)
def test_a_trace_equals_the_command_line_to_all_digits(
    number: int,
    address: str,
    in_browser: Browse,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    example = examples(tmp_path)[number]
    saved = tmp_path / "saved"
    saved.mkdir()
    page = ""

    async def use(browser: Chromium, _: list[str]) -> None:
        nonlocal page
        tab = await browser.tab()
        await tab.size(1400, 900)
        await tab.open(address)
        await entered(tab, example)
        await computed(tab)
        page = await tab.text()
        await tab.downloads(saved)
        for label, name in (("Save JSON", "ehlwave.json"), ("Save script", "ehlwave_repeat.py")):
            await tab.click(label)
            await until((saved / name).exists, name)
        assert foreign(tab, address) == []
        assert not tab.messages
        if number == FITTED:
            await fits(tab)

    assert in_browser(use) == []
    monkeypatch.chdir(tmp_path)
    command = ["deform", example.path.name, *example.command]
    assert main([*command, "--json"]) == 0
    expected = json.loads(capsys.readouterr().out)
    document = json.loads((saved / "ehlwave.json").read_text())
    assert in_any_order(document["surface"]) == in_any_order(expected)  # to the last bit
    assert main(command) == 0
    for line in capsys.readouterr().out.splitlines():
        if not line.startswith("Others "):
            assert line in page
    ratio = expected["statistics"]["lambda_ratio_after"]
    assert f"{ratio:.4g}" in page

    (saved / example.path.name).write_bytes(example.path.read_bytes())
    source = str(Path(ehlwave.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "ehlwave_repeat.py"],
        cwd=saved,
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": source},
    )
    assert f"lambda ratio {expected['statistics']['lambda_ratio_before']:.4g}" in done.stdout
    repeated = json.loads((saved / "deformed/deformed.json").read_text())
    assert in_any_order(repeated) == in_any_order(expected)


def test_wrong_numbers_and_files_get_the_message_of_the_command_line(
    address: str,
    in_browser: Browse,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    bad, packed, large = (tmp_path / name for name in ("bad.csv", "zeros.npz", "large.csv"))
    bad.write_text("this is no trace\n1;two;3\n")
    np.savez_compressed(packed, height=np.zeros((3000, 3000)))
    with large.open("wb") as file:
        file.truncate(16_500_000)
    pages: list[str] = []

    async def use(browser: Chromium, _: list[str]) -> None:
        tab = await browser.tab()
        await tab.size(1400, 900)
        await tab.open(address)
        wrong = {"12,7x": "Load = '12,7x' is not a number", "": "Load is missing"}
        for text, sign in wrong.items():
            await tab.fill("Load", text)
            await tab.click("Compute")
            await until(lambda sign=sign: tab.has_text(sign), sign)
            assert await tab.has_text("Field: Load")
        await tab.fill("Load", "40")
        await computed(tab)
        await tab.fill("Load", "41")
        await until(lambda: tab.has_text("Something was changed"), "the mark of an old answer")
        for path in (bad, packed):
            await tab.give_file(path)
            await until(lambda name=path.name: tab.has_text(name), path.name)
            await until(lambda: tab.has_text("Upload complete"), path.name)
            await tab.click("Compute")
            await until(lambda name=path.name: tab.has_text(f"{name}: "), "the error")
            pages.append(await tab.text())
        await tab.give_file(large)
        await until(lambda: tab.has_text("File is too large"), "the refusal")
        pages.append(await tab.text())

    in_browser(use)
    monkeypatch.chdir(tmp_path)
    conditions = examples(tmp_path)[0].command
    assert main(["deform", bad.name, *conditions]) == 2
    message = capsys.readouterr().err.removeprefix("ehlwave: error: ").strip()
    assert message in pages[0]
    assert "unpacked 72.0 MB, more than the 64 MB" in pages[1]
    assert "Maximum file size is 16 MB" in pages[2]
    assert "Traceback" not in "".join(pages)
    assert "/tmp" not in "".join(pages)


def test_sessions_at_once_answer_each_its_own(
    address: str, in_browser: Browse, tmp_path: Path
) -> None:
    loads = [40 + 2 * number for number in range(SESSIONS)]
    films = [ehlwave.Contact(**BALL | {"load_n": load}).film() for load in loads]
    expected = [f"Film {1e6 * (film.central_m or 0):.4g} um" for film in films]
    assert len(set(expected)) == len(expected)

    async def use(browser: Chromium, _: list[str]) -> None:
        tabs = [await browser.tab() for _ in loads]
        for tab in tabs:
            # In turn: a browser requests an address only once at a time.
            await tab.send("Page.navigate", url=address)
        for tab in tabs:
            await until(lambda tab=tab: tab.shows_text("Compute"), "the page")
        for tab, load in zip(tabs, loads, strict=True):
            await tab.click("Reduced")
            # The two bodies have a load, too: wait until theirs is hidden.
            await gone(tab, "Material")
            await until(lambda tab=tab: tab.shows("Reduced modulus E'"), "its fields")
            await tab.fill("Load", str(load))
        await asyncio.gather(*(tab.click("Compute") for tab in tabs))
        for tab, film in zip(tabs, expected, strict=True):
            await until(lambda tab=tab, film=film: tab.has_line(film), film)
        for tab, film in zip(tabs, expected, strict=True):
            assert await tab.has_line(film)
            assert foreign(tab, address) == []

    assert in_browser(use) == []


def test_no_other_host_is_asked_and_the_check_would_see_it(
    address: str, in_browser: Browse, tmp_path: Path
) -> None:
    async def use(browser: Chromium, asked: list[str]) -> None:
        tab = await browser.tab()
        await tab.open(address)
        await computed(tab)
        await asyncio.sleep(1)
        assert foreign(tab, address) == []
        assert asked == []
        # The page's own policy refuses a script, a picture and a request from elsewhere.
        await tab.script("fetch('http://elsewhere.example/a').catch(() => 0), 0")
        await tab.script("new Image().src = 'http://elsewhere.example/b', 0")
        await until(lambda: len(tab.messages) >= 2, "the policy refuses")
        assert asked == []
        # Without the policy the proxy sees it.
        other = await browser.tab()
        await other.script("new Image().src = 'http://elsewhere.example/c', 0")
        await until(lambda: asked, "the proxy is asked")
        assert any("elsewhere.example/c" in one for one in other.requests)

    asked = in_browser(use)
    assert all("elsewhere.example/c" in one for one in asked)
