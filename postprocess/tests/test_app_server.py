"""The server of the page: its answers to requests without a browser."""

import contextlib
import http.client
import os
import socket
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest

pytest.importorskip("panel", reason="the page needs Panel: pip install './postprocess[app]'")

from app_server import running

from ehlwave.cli import main

MOST = 5
"""Sessions that the server allows at once."""


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    few = f"import ehlwave.app.server; ehlwave.app.server.MOST_SESSIONS = {MOST}; "
    with running(tmp_path_factory.mktemp("app"), before=few) as found:
        yield found


def asked(address: str, path: str, method: str = "GET", **headers: str) -> tuple[int, bytes]:
    """Return status and body; the path is sent unchanged, unlike in browsers."""
    connection = http.client.HTTPConnection(urlsplit(address).netloc, timeout=60)
    try:
        connection.putrequest(method, path, skip_host=True)
        connection.putheader("Host", headers.pop("Host", urlsplit(address).netloc))
        for name, value in headers.items():
            connection.putheader(name.replace("_", "-"), value)
        connection.endheaders()
        answer = connection.getresponse()
        return answer.status, answer.read()
    finally:
        connection.close()


def test_the_page_and_what_it_needs_is_served_by_the_server_itself(address: str) -> None:
    status, page = asked(address, "/")
    assert status == 200
    assert b"Content-Security-Policy" in page
    sources = [
        word.split(b'"')[0] for start in (b'src="', b'href="') for word in page.split(start)[1:]
    ]
    assert len(sources) > 5
    for source in sources:
        assert not source.startswith((b"http", b"//")), source
    script = next(word for word in sources if word.endswith(b".js") or b".js?" in word)
    assert asked(address, f"/{script.decode()}")[0] == 200


def test_a_session_begun_by_a_socket_has_its_styles_from_the_server(address: str) -> None:
    pytest.importorskip("panel.models.file_dropper")  # names of models that documents are made of
    from bokeh.client import pull_session
    from bokeh.models import ImportedStyleSheet

    session = pull_session(url=address)
    try:
        roots = session.document.roots
        found = {one.url for root in roots for one in root.select({"type": ImportedStyleSheet})}
    finally:
        session.close()
    assert len(found) > 3
    assert [url for url in found if not url.startswith("static/")] == []


PLACES = (
    "/../../../../../../../../etc/passwd",
    "/etc/passwd",
    "//etc/passwd",
    "/static/../../../../../../../../etc/passwd",
    "/static//etc/passwd",
    "/static/js/../../../../../../../../etc/passwd",
    "/static/js/%2e%2e/%2e%2e/%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd",
    "/static/js/..%2f..%2f..%2f..%2f..%2f..%2fetc/passwd",
    "/static/js/..%5c..%5cetc/passwd",
    "/static/js/%252e%252e/%252e%252e/etc/passwd",
    "/static/extensions/panel/../../../../../../../../etc/passwd",
    "/static/extensions/panel/..%2f..%2f..%2fpanel/config.py",
    "/static/extensions/panel//etc/passwd",
    "/static/extensions/panel/%00/etc/passwd",
    "/static/extensions/ehlwave/app/server.py",
    "/components/ehlwave.app.page/Page/_css/etc/passwd",
    "/components/panel.widgets/FileDropper/_stylesheets/../../config.py",
    "/components/panel.template.vanilla/VanillaTemplate/_css/%2fetc%2fpasswd",
    "/components/antigravity/a/_css/b",
    "/autoload.js",
    "/metadata",
    "/admin",
    "/liveness",
    "/rest/session_info",
    "/files/trace.csv",
    "/server.log",
    "/ehlwave-app-/trace.csv",
)


@pytest.mark.parametrize("path", PLACES)
@pytest.mark.parametrize("method", ["GET", "HEAD", "POST"])
def test_nothing_else_is_there(address: str, path: str, method: str) -> None:
    status, body = asked(address, path, method)
    assert status == 404, body[:200]
    assert b"root:" not in body
    assert str(Path(__file__).parents[1]).encode() not in body


def test_a_socket_from_another_site_is_refused(address: str) -> None:
    websocket = {
        "Upgrade": "websocket",
        "Connection": "Upgrade",
        "Sec_WebSocket_Version": "13",
        "Sec_WebSocket_Key": "dGhlIHNhbXBsZSBub25jZQ==",
        "Sec_WebSocket_Protocol": "bokeh, none",
    }
    assert asked(address, "/ws", Origin="http://elsewhere.example:5006", **websocket)[0] == 403


@pytest.mark.parametrize("host", ["elsewhere.example", "127.0.0.1.elsewhere.example", "", "::"])
def test_other_names_are_refused(address: str, host: str) -> None:
    """A page elsewhere whose name is turned to this computer must not reach the server."""
    port = address.rpartition(":")[2]
    assert asked(address, "/", Host=f"{host}:{port}")[0] in (400, 403)
    assert asked(address, "/", Origin=f"http://{host}:{port}")[0] == 403
    for name in ("localhost", "LOCALHOST"):
        assert asked(address, "/", Host=f"{name}:{port}")[0] == 200


def test_sessions_begin_with_sockets_and_are_limited(address: str) -> None:
    pytest.importorskip("panel.models.file_dropper")
    from bokeh.client import pull_session

    pages = {asked(address, "/")[1] for _ in range(2)}
    before = megabytes_of_servers()
    pages |= {asked(address, "/")[1] for _ in range(20)}
    assert len(pages) == 22  # each has its own token
    assert megabytes_of_servers() - before < 10
    sessions = [pull_session(url=address) for _ in range(2)]
    with pytest.raises(OSError, match="503"):
        sessions += [pull_session(url=address) for _ in range(MOST)]
    for session in sessions:
        session.close()


def megabytes_of_servers() -> float:
    """Return the memory of the servers that this process started; 0 where it is not to be known."""
    total = 0
    for path in Path("/proc").glob("[0-9]*/status"):
        with contextlib.suppress(OSError):
            text = path.read_text()
            if f"PPid:\t{os.getpid()}\n" in text and "VmRSS:" in text:
                total += int(text.split("VmRSS:")[1].split()[0])
    return total / 1e3


def test_other_computers_cannot_reach_it(address: str) -> None:
    others = {found[4][0] for found in socket.getaddrinfo(socket.gethostname(), None)}
    others = {one for one in others if not one.startswith("127.") and ":" not in one}
    if not others:
        pytest.skip("this computer has no address but loopback")
    port = int(address.rpartition(":")[2])
    for one in others:
        with pytest.raises(OSError, match=r"refused|unreachable|timed out"):
            socket.create_connection((one, port), timeout=5).close()


def test_a_port_that_is_taken_and_one_that_is_none(
    address: str, capsys: pytest.CaptureFixture[str]
) -> None:
    port = address.rpartition(":")[2]
    assert main(["app", "--port", port]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"ehlwave: error: app: cannot listen on 127.0.0.1, port {port}")
    assert "--port" in said
    with pytest.raises(SystemExit):
        main(["app", "--port", "70000"])
    assert "is not a port" in capsys.readouterr().err
