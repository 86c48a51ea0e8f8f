"""A fragility curve: the share of walls that fall in an earthquake, over its acceleration.

Friction, bond and bricks of each wall are random. The walls are worked on by the processes of a cluster of dask, here one on this
machine: results come as they are done, a wall that cannot be built does not stop the others, and the walls of a process that dies
are done again.

    python many_walls.py [WALLS] [PICTURE]

needs ``pip install "dask[distributed]" matplotlib``.
"""

import sys

import numpy as np

import masonry

GRAVITY = 9.81


def random_wall(seed):
    """Give a wall of 3 m x 2.5 m with random friction, bond and length of bricks."""
    rng = np.random.default_rng(seed)
    return masonry.Scene(
        title=f"Wall {seed}",
        thickness=0.25,
        gravity=[0, -GRAVITY],
        units={"length": "m", "force": "kN"},
        materials={"brick": {"density": 1800}},
        joints={"bed": {"mu": rng.normal(0.6, 0.1)}, "head": {"mu": 0.6}},
        walls=[
            {
                "name": "wall",
                "material": "brick",
                "origin": [0, 0],
                "width": 3.0,
                "courses": 10,
                "bond": str(rng.choice(["running", "stack", "english"])),
                "brick": {"length": 3.0 / int(rng.integers(5, 11)), "height": 0.25},
            }
        ],
        supports=[{"name": "ground", "from": [0, 0], "to": [3, 0], "joint": "bed"}],
        # An acceleration of one g: the factor at which the wall fails is the acceleration in g.
        loads=[{"name": "earthquake", "acceleration": [GRAVITY, 0]}],
        limit={"group": "earthquake"},
    )


def strength(scene):
    """Give the acceleration in g that a wall stands, up to which forces within friction balance it."""
    return scene.limit(law="associative").details["associative"]["load_factor"]


def strengths(scenes, client):
    """Give the strength of each scene, not a number if it has none, and what went wrong."""
    found, failed = np.full(len(scenes), np.nan), []
    for done in masonry.map(scenes, strength, executor=client.get_executor(), progress=True):
        if done.error is None:
            found[done.index] = done.result
        else:
            failed.append(done)
    return found, failed


def draw(found, path):
    """Draw the share of walls that fall over the acceleration."""
    from matplotlib.figure import Figure

    ordered = np.sort(found[np.isfinite(found)])
    share = np.arange(1, len(ordered) + 1) / len(ordered)
    middle = np.median(ordered)
    figure = Figure(figsize=(7, 4), layout="constrained")
    axes = figure.add_subplot()
    axes.step(ordered, share, where="post", color="#1f4e79")
    axes.axvline(middle, color="#8a8a8a", linestyle="--", linewidth=1)
    axes.annotate(f"median {middle:.2f} g", (middle, 0.05), (5, 0), textcoords="offset points")
    axes.set(
        xlabel="horizontal acceleration [g]",
        ylabel="share of walls that fall",
        title=f"{len(ordered)} walls with random friction, bond and bricks",
        ylim=(0, 1),
    )
    axes.grid(alpha=0.3)
    figure.savefig(path)


def main(count=1000, path="fragility.svg"):
    from dask.distributed import Client, LocalCluster

    with LocalCluster(threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        found, failed = strengths([random_wall(seed) for seed in range(count)], client)
    for done in failed:
        print(f"{done.scene['title']}: {done.error}")
    draw(found, path)
    print(f"{np.isfinite(found).sum()} walls, median {np.nanmedian(found):.3f} g, picture in {path}")


if __name__ == "__main__":
    main(*(int(it) if it.isdigit() else it for it in sys.argv[1:]))
