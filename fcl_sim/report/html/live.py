"""A page that follows what is saved: served to this machine alone, with events that tell of a new one."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from queue import Empty, Queue
from threading import Lock, Thread
from urllib.parse import urlsplit

HERE = "127.0.0.1"
PORT = 8642
"""Where the page is, if that is free."""
PATIENCE = 15.0
"""Seconds after which a listener is told that we are still there."""

Event = tuple[str, str]


class Live:
    """The page as it is now, and who listens; used from any thread."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._page = b""
        self._version = 0
        self._trouble = ""
        self._listeners: list[Queue[Event]] = []

    @property
    def page(self) -> bytes:
        """The page as it is now."""
        return self._page

    def show(self, version: int, page: str) -> None:
        """Put a page in the place of the last one; its number rises. Who listens fetches it."""
        with self._lock:
            self._page, self._version, self._trouble = page.encode("utf-8"), version, ""
            self._tell(("changed", ""))

    def warn(self, text: str) -> None:
        """Say above the page, which stays, what is wrong with what was saved."""
        with self._lock:
            self._trouble = text
            self._tell(("broken", text))

    def end(self) -> None:
        """Say that no page follows."""
        with self._lock:
            self._tell(("ended", ""))

    def _tell(self, event: Event) -> None:
        for each in self._listeners:
            each.put(event)

    @contextmanager
    def listener(self, seen: str) -> Iterator["Queue[Event]"]:
        """Hand out the events from now on, to one who has seen the page of a number."""
        own: Queue[Event] = Queue()
        with self._lock:
            self._listeners.append(own)
            if seen != str(self._version):
                own.put(("changed", ""))
            if self._trouble:
                own.put(("broken", self._trouble))
        try:
            yield own
        finally:
            with self._lock:
                self._listeners.remove(own)


@contextmanager
def served(live: Live, port: int = PORT) -> Iterator[str]:
    """Serve a page while the block runs, at `port` if that is free; hand out its address."""
    server = _server(live, port)
    thread = Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05}, daemon=True)
    thread.start()
    try:
        yield f"http://{HERE}:{server.server_address[1]}/"
    finally:
        live.end()
        server.shutdown()
        server.server_close()
        thread.join()


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False
    live: Live


def _server(live: Live, port: int) -> _Server:
    try:
        server = _Server((HERE, port), _Handler)
    except OSError:  # another one has it
        server = _Server((HERE, 0), _Handler)
    server.live = live
    return server


class _Handler(BaseHTTPRequestHandler):
    """Gives the page and its events to who asks for this machine by its own name."""

    server: _Server

    def do_GET(self) -> None:  # the base class's name
        """Answer a request."""
        asked = urlsplit(self.path)
        port = self.server.server_address[1]
        if self.headers.get("Host") not in {f"{HERE}:{port}", f"localhost:{port}"}:
            self.send_error(HTTPStatus.FORBIDDEN)  # a name of another's that leads here
        elif asked.path == "/":
            self._give(self.server.live.page)
        elif asked.path == "/events":
            self._tell(asked.query)
        else:
            self.send_error(HTTPStatus.NOT_FOUND)

    def _give(self, page: bytes) -> None:
        self._head("text/html; charset=utf-8", length=len(page))
        self.wfile.write(page)

    def _tell(self, seen: str) -> None:
        self._head("text/event-stream; charset=utf-8")
        try:
            with self.server.live.listener(seen) as events:
                while True:
                    name, text = self._next(events)
                    self.wfile.write(f"event: {name}\ndata: {json.dumps(text)}\n\n".encode())
                    if name == "ended":
                        return
        except ConnectionError:
            return  # the page was closed

    def _next(self, events: "Queue[Event]") -> Event:
        while True:
            try:
                return events.get(timeout=PATIENCE)
            except Empty:
                self.wfile.write(b": still here\n\n")

    def _head(self, kind: str, length: int | None = None) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", kind)
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        if length is not None:
            self.send_header("Content-Length", str(length))
        self.end_headers()

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002  the base class's name
        """Keep silent: who asked for the page sees it."""
