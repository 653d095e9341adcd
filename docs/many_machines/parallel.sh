#!/usr/bin/env bash
# Ranks a data set with GNU parallel: `parallel.sh gt/ ours/ theirs/`, in PARTS (8) parts. `parallel --sshlogin` takes other machines that
# see the same folder. A part whose program ends without success is tried again.
set -euo pipefail
parts=${PARTS:-8}
rank=(svbrdf rank --dataset "$@" --results losses)

parallel --retries 4 --jobs "${JOBS:-2}" --quote -I @part@ "${rank[@]}" --shard "@part@/$parts" ::: $(seq "$parts") >/dev/null
"${rank[@]}"
