"""Threads that answer: few, and a separate thread for large surfaces, so that small ones pass."""

import os
from concurrent.futures import ThreadPoolExecutor

SMALL_BYTES = 2**20
"""A file above this is large."""

LONGEST_S = 120.0
"""Until a page gives an answer up, seconds; the wait for a free thread counts."""


class Pools:
    """The threads of a server."""

    def __init__(self, workers: int | None = None) -> None:
        """Make them; by default as many for small tasks as there are cores, 2 to 8."""
        count = workers or min(8, max(2, os.cpu_count() or 2))
        self.small = ThreadPoolExecutor(count, "ehlwave-app")
        self.large = ThreadPoolExecutor(1, "ehlwave-app-large")

    def of(self, size: int) -> ThreadPoolExecutor:
        """Return the threads for a file of this size."""
        return self.small if size <= SMALL_BYTES else self.large

    def close(self) -> None:
        """Finish running work, and begin no more."""
        for pool in (self.small, self.large):
            pool.shutdown(wait=False, cancel_futures=True)
