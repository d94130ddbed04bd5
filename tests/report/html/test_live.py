"""A page that is served: to this machine by its own name, with events of what changed."""

import json
from contextlib import contextmanager
from http.client import HTTPConnection
from urllib.parse import urlsplit

import pytest

from fcl_sim.report.html import page
from fcl_sim.report.html.live import HERE, Live, served
from tests.report.html.pages import Page


@pytest.fixture
def live():
    made = Live()
    made.show(1, "<p>µ</p>")
    return made


@contextmanager
def asked(address, path, **headers):
    """Ask a server for a path; the answer, and the connection behind it, are closed at the end."""
    parts = urlsplit(address)
    connection = HTTPConnection(parts.hostname, parts.port, timeout=10)
    try:
        connection.request("GET", path, headers=headers)
        yield connection.getresponse()
    finally:
        connection.close()


def event(answer):
    """Return the next event: its name and what it says."""
    name = answer.readline().decode().removeprefix("event: ").strip()
    data = answer.readline().decode().removeprefix("data: ")
    assert answer.readline() == b"\n"
    return name, json.loads(data)


def test_it_gives_the_page_and_nothing_else_to_this_machine_alone(live):
    with served(live, port=0) as address:
        assert urlsplit(address).hostname == HERE == "127.0.0.1"
        with asked(address, "/") as answer:
            assert answer.status == 200
            assert answer.read().decode("utf-8") == "<p>µ</p>"
        with asked(address, "/../pyproject.toml") as answer:
            assert answer.status == 404
        with asked(address, "/", Host="elsewhere.example") as answer:
            assert answer.status == 403


def test_who_listens_is_told_of_a_new_page_of_faults_and_of_the_end(live):
    with served(live, port=0) as address, asked(address, "/events?1") as answer:
        live.show(2, "<p>new</p>")
        assert event(answer) == ("changed", "")
        live.warn("crane.fcl:3:1\n  a < b")
        assert event(answer) == ("broken", "crane.fcl:3:1\n  a < b")
        live.end()
        assert event(answer) == ("ended", "")
        assert answer.read() == b""


def test_who_comes_late_is_told_what_was_missed(live):
    live.show(2, "<p>new</p>")
    live.warn("wrong")
    with served(live, port=0) as address, asked(address, "/events?1") as answer:
        assert [event(answer), event(answer)] == [("changed", ""), ("broken", "wrong")]
        live.end()


def test_two_can_be_served_at_once(live):
    with served(live) as one, served(live) as other:
        assert one != other


def test_a_live_page_may_ask_only_where_it_comes_from_and_says_what_it_leaves_out():
    made = Page(page([], live=7))
    policy = next(given["content"] for _, given in made.elements if "http-equiv" in given)
    assert "connect-src 'self'" in policy
    assert made.attributes("data-live") == ["7"]
    assert any("Envelopes and baselines are left out" in each for each in made.texts["p"])
