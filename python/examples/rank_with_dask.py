"""Ranks a data set on a Dask cluster: `python rank_with_dask.py gt/ ours/ theirs/` writes ranking.txt.

All machines see the folder and have the program `svbrdf`. Dask repeats a part whose worker is killed.
Needs `distributed`.
"""

import subprocess
import sys

from dask.distributed import Client

RANK = ["svbrdf", "rank", "--dataset", *sys.argv[1:], "--results", "losses"]
PARTS = 8


def rank(part: int) -> None:
    """Evaluates one part of the data set."""
    subprocess.run([*RANK, "--shard", f"{part}/{PARTS}"], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    client = Client()
    client.gather(client.map(rank, range(1, PARTS + 1), retries=3, pure=False))
    with open("ranking.txt", "w") as ranking:
        subprocess.run(RANK, check=True, stdout=ranking)
