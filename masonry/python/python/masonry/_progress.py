"""Bars that show the progress of work."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol

#: Seconds between two lines. Chosen: as tqdm does.
_REST = 0.1


class Bar(Protocol):
    """A bar, or a line that replaces the bar."""

    def at(self, number: int, note: str = "", total: int | None = None) -> None:
        """Show a number, and a note behind it."""


class _Tqdm:
    """A bar of tqdm."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar

    def at(self, number: int, note: str = "", total: int | None = None) -> None:
        if total is not None:
            self._bar.total = total
        self._bar.set_postfix_str(note, refresh=False)
        # Each of several methods in sequence begins at zero.
        if number < self._bar.n:
            self._bar.reset(self._bar.total)
        self._bar.update(number - self._bar.n)

    def close(self) -> None:
        self._bar.close()


class _Line:
    """A line on standard error, if tqdm is not installed."""

    def __init__(self, label: str, total: int | None) -> None:
        self._label, self._total = label, total
        self._shown = 0.0
        self._text = ""

    def at(self, number: int, note: str = "", total: int | None = None) -> None:
        self._total = self._total if total is None else total
        of = "" if self._total is None else f"/{self._total}"
        self._text = f"{self._label} {number}{of} {note}"
        if time.monotonic() - self._shown >= _REST:
            self._write()

    def _write(self) -> None:
        self._shown = time.monotonic()
        sys.stderr.write(f"\r{self._text}\x1b[K")
        sys.stderr.flush()

    def close(self) -> None:
        self._write()
        sys.stderr.write("\n")


@contextmanager
def bar(wanted: bool, label: str, total: int | None = None) -> Iterator[Bar | None]:
    """Give a bar with this label, and ``None`` if no bar is wanted."""
    if not wanted:
        yield None
        return
    shown = _made(label, total)
    try:
        yield shown
    finally:
        shown.close()


def _made(label: str, total: int | None) -> _Tqdm | _Line:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line(label, total)
    return _Tqdm(tqdm(desc=label, total=total))
