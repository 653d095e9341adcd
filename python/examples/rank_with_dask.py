"""Ranks a data set on a Dask cluster: `python rank_with_dask.py gt/ ours/ theirs/` writes ranking.txt.

All machines see the folder and have the program `svbrdf`. Dask repeats a part whose worker is killed, which continues
from its journal. Needs `distributed`.
"""

import subprocess
import sys

from dask.distributed import Client

PARTS = 8


def rank(part: int, folders: list[str]) -> None:
    """Evaluates one part of the data set."""
    shard = ["--journal", f"part{part}.jsonl", "--shard", f"{part}/{PARTS}"]
    subprocess.run(["svbrdf", "rank", "--dataset", *folders, *shard], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    client = Client()
    client.gather(client.map(rank, range(1, PARTS + 1), folders=sys.argv[1:], retries=3, pure=False))
    with open("ranking.txt", "w") as ranking:
        subprocess.run(["svbrdf", "rank", "--merge", "part*.jsonl"], check=True, stdout=ranking)
