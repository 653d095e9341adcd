"""Ranks a data set on a Ray cluster: `python rank_with_ray.py gt/ ours/ theirs/` writes ranking.txt.

All machines see the folder and have the program `svbrdf`. Ray repeats a part whose worker is killed, which continues
from its journal. Needs `ray`.
"""

import subprocess
import sys

import ray

PARTS = 8


def rank(part: int, folders: list[str]) -> None:
    """Evaluates one part of the data set."""
    shard = ["--journal", f"part{part}.jsonl", "--shard", f"{part}/{PARTS}"]
    subprocess.run(["svbrdf", "rank", "--dataset", *folders, *shard], check=True, stdout=subprocess.DEVNULL)


task = ray.remote(max_retries=3, retry_exceptions=True)(rank)
ray.get([task.remote(part, sys.argv[1:]) for part in range(1, PARTS + 1)])
with open("ranking.txt", "w") as ranking:
    subprocess.run(["svbrdf", "rank", "--merge", "part*.jsonl"], check=True, stdout=ranking)
