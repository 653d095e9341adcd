#!/usr/bin/env bash
# Ranks a data set with GNU parallel: `parallel.sh gt/ ours/ theirs/`, in PARTS (8) parts. `parallel --sshlogin` takes other machines that
# see the same folder. A part whose program ends without success is tried again and continues from its journal.
set -euo pipefail
parts=${PARTS:-8}

parallel --retries 4 --jobs "${JOBS:-2}" \
    svbrdf rank --dataset "$@" --journal part{}.jsonl --shard "{}/$parts" '>/dev/null' ::: $(seq "$parts")
svbrdf rank --merge 'part*.jsonl'
