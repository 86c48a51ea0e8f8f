"""Memory: solves that go on for long, and large matrices."""

import gc
import subprocess
import sys
import textwrap
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import lcp

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="memory is read as Linux tells it")


def resident():
    """Give the memory of the process in bytes."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


def test_a_hundred_thousand_solves_in_four_threads_keep_their_memory():
    rng = np.random.default_rng(3)
    a = rng.standard_normal((6, 6))
    M, right = a @ a.T + np.eye(6), rng.standard_normal((50, 6))

    def work(count):
        box = lcp.Contact2d(np.eye(2), [0.3, -1.0])
        box.add_point({1: 1.0}, {0: 1.0}, mu=0.5)
        steps = lcp.Sequence(M)
        for k in range(count):
            q = right[k % 50]
            if k % 10 == 0:
                assert lcp.solve(M, q).is_solved and box.solve().is_solved
            else:
                steps.solve(q)

    # The same four threads work before and after, since the allocator keeps an arena for each.
    with ThreadPoolExecutor(4) as threads:

        def after(count):
            for done in [threads.submit(work, count // 4) for _ in range(4)]:
                done.result()
            gc.collect()
            return resident()

        before = after(20_000)
        growth = after(100_000) - before
    # A leak of a solution in each solve would be 30 MB or more.
    assert growth < 8 << 20


#: What reading a tridiagonal matrix of a million unknowns adds to the peak of a process, in bytes. A right-hand side that is
#: wrong ends the solve after that.
READ = """
    import resource, sys
    import numpy as np, scipy.sparse
    import lcp

    def peak():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024

    n = 10**6
    M = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n), format=sys.argv[1])
    q = np.full(n, np.nan)
    before = peak()
    try:
        lcp.solve(M, q)
    except ValueError as error:
        assert "NaN" in str(error)
        print(peak() - before)
"""


def test_a_million_unknowns_are_copied_once():
    n, entries = 10**6, 3 * 10**6 - 2
    # Numbers and indices of 8 bytes, starts of columns, and the vector with the sums of rows by which it is checked.
    once = 16 * entries + 8 * n + 2 * 8 * n
    for form in ("csc", "csr"):
        program = [sys.executable, "-c", textwrap.dedent(READ), form]
        added = int(subprocess.run(program, capture_output=True, text=True, check=True).stdout)
        # Rows need the next free place of every column besides.
        assert added < once + 8 * n + (2 << 20), form
