"""Ranks a data set on a Ray cluster: `python rank_with_ray.py gt/ ours/ theirs/`, in a folder that all machines see. Writes ranking.txt.

A part whose worker is killed is repeated by Ray, and continues from its journal. Needs the program `svbrdf` and `ray`.
"""

import subprocess
import sys

import ray

PARTS = 8


@ray.remote(max_retries=3, retry_exceptions=True)
def rank(part: int, folders: list[str]) -> None:
    """Evaluates one part of the data set."""
    shard = ["--journal", f"part{part}.jsonl", "--shard", f"{part}/{PARTS}"]
    subprocess.run(["svbrdf", "rank", "--dataset", *folders, *shard], check=True, stdout=subprocess.DEVNULL)


ray.get([rank.remote(part, sys.argv[1:]) for part in range(1, PARTS + 1)])
with open("ranking.txt", "w") as ranking:
    subprocess.run(["svbrdf", "rank", "--merge", "part*.jsonl"], check=True, stdout=ranking)
