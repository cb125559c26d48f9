"""Chromium without a head, by its remote debugging protocol: enough to use a page as a user does.

Needs Tornado, which Panel brings. Every wait ends.
"""

import asyncio
import contextlib
import json
import os
import shutil
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tornado.httpclient import AsyncHTTPClient
from tornado.websocket import websocket_connect

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser")
LONGEST = 120.0
"""Seconds that anything may take, on a busy machine, too."""

NOWHERE = "http://127.0.0.1:9"

FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--hide-scrollbars",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--no-default-browser-check",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-default-apps",
    "--disable-sync",
    "--disable-extensions",
    "--metrics-recording-only",
    "--no-pings",
    "--disable-features=OptimizationHints,MediaRouter,Translate,AutofillServerCommunication,"
    "NetworkTimeServiceQuerying",
    "--disable-background-timer-throttling",
    "--disable-renderer-backgrounding",
    "--disable-backgrounding-occluded-windows",
    "--remote-debugging-port=0",
    # Browsers have questions of their own for hosts of their makers: they go nowhere.
    *(f"--{name}-url={NOWHERE}" for name in ("gaia", "google", "google-apis", "variations-server")),
    f"--component-updater=url-source={NOWHERE}",
)

FIND = """
(function find(root, test) {
  for (const one of root.querySelectorAll('*')) {
    if (test(one)) return one;
    if (one.shadowRoot) { const inner = find(one.shadowRoot, test); if (inner) return inner; }
  }
  return null;
})
"""
"""A function of JavaScript that looks into shadow roots, too."""


async def until(test: Callable[[], Any], meaning: str) -> Any:  # noqa: ANN401
    """Wait for something, LONGEST seconds at most."""
    end = time.monotonic() + LONGEST
    while time.monotonic() < end:
        found = test()
        if asyncio.iscoroutine(found):
            found = await found
        if found:
            return found
        await asyncio.sleep(0.4)
    raise TimeoutError(f"{meaning}: not within {LONGEST:g} s")


class Chromium:
    """A browser; use it within `async with`."""

    def __init__(self, folder: Path, *flags: str) -> None:
        """Start nothing yet; everything of the browser is kept in the folder."""
        self.folder, self.flags = folder, flags
        self.tabs: list[Tab] = []

    async def __aenter__(self) -> "Chromium":
        """Start the browser."""
        self.folder.mkdir(parents=True, exist_ok=True)
        words = [str(PROGRAM), *FLAGS, *self.flags, f"--user-data-dir={self.folder}", "about:blank"]
        with (self.folder / "log").open("w") as log:
            self.process = subprocess.Popen(
                words, stdout=log, stderr=log, stdin=subprocess.DEVNULL, start_new_session=True
            )
        try:
            place = self.folder / "DevToolsActivePort"
            await until(lambda: place.exists() and len(place.read_text().split()) == 2, "chromium")
        except BaseException:
            self._kill()
            raise
        self.address = f"http://127.0.0.1:{place.read_text().split()[0]}"
        return self

    async def __aexit__(self, *_: object) -> None:
        """End the browser that was started here, and its own processes alone."""
        await self.close_tabs()
        self._kill()

    async def close_tabs(self) -> None:
        """Close all tabs."""
        for tab in self.tabs:
            await tab.close()
        self.tabs.clear()

    def _kill(self) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait(LONGEST)

    async def tab(self) -> "Tab":
        """Open a tab."""
        found = await AsyncHTTPClient().fetch(
            f"{self.address}/json/new?about:blank", method="PUT", body=b"", request_timeout=LONGEST
        )
        tab = Tab()
        await tab.connect(json.loads(found.body)["webSocketDebuggerUrl"])
        self.tabs.append(tab)
        return tab


class Tab:
    """A tab of a browser."""

    def __init__(self) -> None:
        """Start without state."""
        self.requests: list[str] = []
        self.messages: list[str] = []
        self._waiting: dict[int, asyncio.Future[Any]] = {}
        self._number = 0

    async def connect(self, url: str) -> None:
        """Listen to the tab."""
        self.socket = await websocket_connect(url, max_message_size=2**28)
        self._reader = asyncio.create_task(self._read())
        for domain in ("Page", "Network", "Runtime", "DOM", "Log"):
            await self.send(f"{domain}.enable")

    async def close(self) -> None:
        """Close the tab and listen no more."""
        with contextlib.suppress(Exception):
            await self.send("Page.close")
        self._reader.cancel()
        self.socket.close()

    async def _read(self) -> None:
        while (text := await self.socket.read_message()) is not None:
            said = json.loads(text)
            if "id" in said:
                self._waiting.pop(said["id"]).set_result(said)
            elif said["method"] in ("Network.requestWillBeSent", "Network.webSocketCreated"):
                found = said["params"]
                self.requests.append(found.get("url") or found["request"]["url"])
            elif said["method"] in ("Log.entryAdded", "Runtime.exceptionThrown"):
                self.messages.append(json.dumps(said["params"])[:2000])

    async def send(self, method: str, **parameters: object) -> dict[str, Any]:
        """Return the answer of the browser to a command."""
        self._number += 1
        self._waiting[self._number] = asyncio.get_running_loop().create_future()
        answer = self._waiting[self._number]
        await self.socket.write_message(
            json.dumps({"id": self._number, "method": method, "params": parameters})
        )
        found = await asyncio.wait_for(answer, LONGEST)
        assert "error" not in found, f"{method}: {found}"
        return found["result"]

    async def script(self, text: str) -> Any:  # noqa: ANN401
        """Return the value of an expression of JavaScript."""
        found = await self.send("Runtime.evaluate", expression=text, returnByValue=True)
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    async def size(self, width: int, height: int) -> None:
        """Make the window as large as that."""
        await self.send(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )

    async def open(self, url: str) -> None:
        """Open a page and wait until its fields are there."""
        await self.send("Page.navigate", url=url)
        await until(lambda: self.shows_text("Compute"), f"{url} is shown")

    async def text(self) -> str:
        """Return all text of the page."""
        return await self.script(
            "(function all(n) { if (!n) return ''; if (n.nodeType == 3) return n.data; let t = '';"
            "if (['STYLE', 'SCRIPT'].includes(n.nodeName)) return '';"
            "if (n.shadowRoot) t += all(n.shadowRoot);"
            "for (const c of n.childNodes) t += all(c); return t + '\\n'; })(document.body)"
        )

    async def has_text(self, part: str) -> bool:
        """Return whether the page has a text."""
        return part in await self.text()

    async def has_line(self, part: str) -> bool:
        """Return whether the page has a text, whatever its parts are set in."""
        return part in " ".join((await self.text()).split())

    async def shows(self, label: str) -> bool:
        """Return whether a field with this label is seen."""
        return await self.script(self._field(label, 0) + " != null")

    async def shows_text(self, text: str) -> bool:
        """Return whether an element of this text is seen."""
        test = f"n => n.textContent.trim() == {json.dumps(text)} && n.getClientRects().length > 0"
        return await self.script(f"{FIND}(document, {test}) != null")

    async def fill(self, label: str, text: str, number: int = 0) -> None:
        """Type into a field that has this label (the number-th of those that are shown)."""
        await until(lambda: self.shows(label), label)
        await self.script(
            f"(f => {{ f.focus(); if (f.select) f.select(); }})({self._field(label, number)})"
        )
        await self.send("Input.insertText", text=text) if text else await self._key("Delete", 46)
        await self._key("Tab", 9)

    async def choose(self, label: str, text: str) -> None:
        """Choose an option, by its text, of the choice with this label."""
        await self.script(
            f"(s => {{ s.value = [...s.options].find(o => o.text == {json.dumps(text)}).value;"
            "s.dispatchEvent(new Event('change', {bubbles: true})); })"
            f"({self._field(label, 0)})"
        )

    async def click(self, text: str) -> None:
        """Click on a textof a button or a title."""
        test = (
            "n => !n.children.length && n.getClientRects().length > 0 && "
            f"n.textContent.trim() == {json.dumps(text)}"
        )
        await until(lambda: self.script(f"{FIND}(document, {test}) != null"), text)
        await self.script(f"{FIND}(document, {test}).click()")

    async def give_file(self, path: Path) -> None:
        """Give a file to the page, as if chosen by the user."""
        test = "n => n.nodeName == 'INPUT' && n.type == 'file'"
        await until(lambda: self.script(f"{FIND}(document, {test}) != null"), "file field")
        found = await self.send("Runtime.evaluate", expression=f"{FIND}(document, {test})")
        handle = found["result"]["objectId"]
        await self.send("DOM.setFileInputFiles", files=[str(path)], objectId=handle)

    async def downloads(self, folder: Path) -> None:
        """Let files be saved there."""
        await self.send("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))

    def _field(self, label: str, number: int) -> str:
        # Labels and their fields share a shadow root; hidden elements have no size.
        return (
            "(function() { const found = []; (function go(root) {"
            "for (const n of root.querySelectorAll('*')) {"
            f"if (n.nodeName == 'LABEL' && n.textContent.trim() == {json.dumps(label)}"
            " && n.getClientRects().length) {"
            "const f = n.parentNode.querySelector('input, select'); if (f) found.push(f); }"
            f"if (n.shadowRoot) go(n.shadowRoot); }} }})(document); return found[{number}] || null;"
            "})()"
        )

    async def _key(self, name: str, code: int) -> None:
        for kind in ("keyDown", "keyUp"):
            await self.send(
                "Input.dispatchKeyEvent", type=kind, key=name, code=name, windowsVirtualKeyCode=code
            )
