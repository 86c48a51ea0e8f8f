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


#: What the reading of a tridiagonal matrix of a million unknowns adds to the memory of a process at its peak, in bytes. A
#: right-hand side that is wrong ends the solve after that.
READ = """
    import sys
    import numpy as np, scipy.sparse
    import lcp

    # The peak of getrusage is also that of the process before exec, the one of the tests.
    def memory(name):
        with open("/proc/self/status") as file:
            return next(int(line.split()[1]) * 1024 for line in file if line.startswith(name))

    n = 10**6
    starts = np.arange(-1, 3 * n, 3, dtype=np.int32)
    starts[0], starts[-1] = 0, 3 * n - 2
    # On the diagonal, after it, and before it in the next row or column.
    indices = np.empty(3 * n - 2, dtype=np.int32)
    indices[0::3] = np.arange(n, dtype=np.int32)
    indices[1::3] = indices[3::3]
    indices[2::3] = indices[0:-1:3]
    values = np.full(3 * n - 2, -1.0)
    values[0::3] = 2.0
    form = scipy.sparse.csc_array if sys.argv[1] == "csc" else scipy.sparse.csr_array
    M = form((values, indices, starts), shape=(n, n))
    q = np.full(n, np.nan)
    # Memory that was used and given back before would hide a copy: the peak counts from what is in use.
    before = memory("VmRSS")
    try:
        lcp.solve(M, q)
    except ValueError as error:
        assert "NaN" in str(error)
        print(memory("VmHWM") - before)
"""


def test_a_million_unknowns_are_copied_once():
    n, entries = 10**6, 3 * 10**6 - 2
    # Numbers and indices of 8 bytes, and three vectors at a time: the starts of columns, and the right-hand side with the sums of
    # rows by which it is checked; before that, for rows, their own starts and the next free place of every column.
    once = 16 * entries + 3 * 8 * n
    for form in ("csc", "csr"):
        program = [sys.executable, "-c", textwrap.dedent(READ), form]
        added = int(subprocess.run(program, capture_output=True, text=True, check=True).stdout)
        # A second copy of the numbers would be 24 MB, and of a vector 8 MB.
        assert once <= added < once + (4 << 20), form
