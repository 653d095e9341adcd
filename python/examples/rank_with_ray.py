"""Ranks a data set on a Ray cluster: `python rank_with_ray.py gt/ ours/ theirs/` writes ranking.txt.

All machines see the folder and have the program `svbrdf`. Ray repeats a part whose worker is killed.
Needs `ray`.
"""

import subprocess
import sys

import ray

RANK = ["svbrdf", "rank", "--dataset", *sys.argv[1:], "--results", "losses"]
PARTS = 8


def rank(part: int) -> None:
    """Evaluates one part of the data set."""
    subprocess.run([*RANK, "--shard", f"{part}/{PARTS}"], check=True, stdout=subprocess.DEVNULL)


task = ray.remote(max_retries=3, retry_exceptions=True)(rank)
ray.get([task.remote(part) for part in range(1, PARTS + 1)])
with open("ranking.txt", "w") as ranking:
    subprocess.run(RANK, check=True, stdout=ranking)
