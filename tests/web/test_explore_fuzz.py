"""The explorer and what nobody foresaw: addresses, paths, queries, messages are answered, by no exception."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("uvicorn", reason="needs the extra: pip install 'rodwell[explore]'")
pytest.importorskip("httpx")
sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from explorer import READY, go, until, values
from fuzz_explorer import HASHES, MESSAGES, TEXTS
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from test_browser import browser, chromium  # noqa: F401 - skips where no Chromium is
from test_explore_server import HERE, HOST, TOKEN, client  # noqa: F401 - a fixture

SHARED = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
REFUSED = {"kind": "failed", "message": "that is no request", "last": True}


@settings(max_examples=60, deadline=None, suppress_health_check=SHARED)
@given(path=TEXTS, query=TEXTS, host=st.sampled_from([HOST, "x", ""]) | TEXTS)
def test_any_path_and_query_is_answered(client: Any, path: str, query: str, host: str) -> None:  # noqa: F811
    """An exception in the server would come out here; a page of it has 200, what is not there 404, others 403."""
    from urllib.parse import quote

    address = f"{HERE}/{TOKEN}/{quote(path)}?{quote(query, safe='&=%')}"
    assert client.get(address).status_code in (200, 403, 404)  # of ../ the client makes another address
    named = {"host": host.encode("ascii", "ignore").decode().strip() or "x"}
    assert client.get(address, headers=named).status_code in (200, 403, 404)
    assert client.get(f"{HERE}/{quote(path)}").status_code == 403


@settings(max_examples=40, deadline=None, suppress_health_check=SHARED)
@given(messages=st.lists(MESSAGES, min_size=1, max_size=6))
def test_any_message_is_answered_and_the_connection_stays(client: Any, messages: list[str | bytes]) -> None:  # noqa: F811
    with client.websocket_connect(f"/{TOKEN}/talk", headers={"host": HOST, "origin": HERE}) as socket:
        assert socket.receive_json()["kind"] == "hello"
        for message in messages:
            if isinstance(message, bytes):
                socket.send_bytes(message)
            else:
                socket.send_text(message)
            heard = socket.receive_json()
            assert heard == REFUSED or heard["kind"] == json.loads(message)["kind"]


@pytest.mark.parametrize("message", [b"{}", "[" * 19_000, '{"kind": "state", "load": NaN}', '{"kind": "\\ud800"}'])
def test_what_is_no_request_is_said_to_be_none(client: Any, message: str | bytes) -> None:  # noqa: F811
    with client.websocket_connect(f"/{TOKEN}/talk", headers={"host": HOST, "origin": HERE}) as socket:
        socket.receive_json()
        (socket.send_bytes if isinstance(message, bytes) else socket.send_text)(message)
        assert socket.receive_json() == REFUSED


READ = """async (hashes) => {
    const { begun, read, written } = await import("./address.js");
    const control = ([name, value]) => ({ name, value });
    const controls = [["dimensionless.weight", 15], ["dimensionless.alpha", 90], ["load.twist", 0]].map(control);
    const all_ends = ["clamped-clamped", "pinned-pinned"];
    const hello = { controls, sections: "", ends: "clamped-clamped", all_ends, modes: 3, most_modes: 6 };
    const text = JSON.stringify, first = text(begun(hello)), names = (each) => Object.keys(each).sort().join();
    return hashes.map((hash) => {
        let state;
        try {
            state = read(hash, hello);
        } catch (error) {
            return { wrong: error.message, plain: error.constructor === Error };
        }
        const numbers = [...controls.map((each) => state.inputs[each.name]), state.load ?? 0, state.until ?? 0];
        const same = text(read(written(state, hello), hello)) === text(state), kept = text(begun(hello)) === first;
        const finite = numbers.every(Number.isFinite);
        return { same, first: kept, finite, names: names(state), inputs: names(state.inputs) };
    });
}"""


@settings(max_examples=12, deadline=None, suppress_health_check=SHARED)
@given(hashes=st.lists(HASHES, min_size=20, max_size=60))
def test_any_address_is_read_or_refused_in_words(page: Any, hashes: list[str]) -> None:
    """The page's own parser: a state that is written and read again as it is, or what is wrong; nothing else."""
    for hash_, found in zip(hashes, page.evaluate(READ, hashes), strict=True):
        if "wrong" in found:
            assert found["plain"], (hash_, found)
            assert found["wrong"], hash_
            continue
        assert found["same"], hash_
        assert found["first"], hash_
        assert found["finite"], hash_
        assert found["names"] == "branch,inputs,load,path,scale,special,until,which,y"
        assert found["inputs"] == "dimensionless.alpha,dimensionless.weight,ends,load.twist,modes,sections"


@settings(max_examples=5, deadline=None, suppress_health_check=SHARED)
@given(text=TEXTS)
def test_an_address_that_is_wrong_gives_one_message_and_the_page_as_it_begins(page: Any, text: str) -> None:
    go(page, "#nothing=" + text.replace("#", ""))
    assert page.inner_text("#message").startswith("The address could not be read: ")
    assert page.locator("[role=alert]:not([hidden])").count() == 1
    until(page, READY)
    assert values(page)["load"] == 118.4
