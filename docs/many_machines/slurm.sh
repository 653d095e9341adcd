#!/usr/bin/env bash
# Ranks a data set as a job array of Slurm: `slurm.sh gt/ ours/ theirs/`, in a folder that all nodes see, with PARTS (8) jobs.
# A part whose program ends without success, or whose node fails, is queued again and continues from its journal.
set -euo pipefail
parts=${PARTS:-8}

# Three more times at most. What fails by itself, such as an unreadable folder, fails each time.
script='
svbrdf rank --dataset "$@" --journal "part$SLURM_ARRAY_TASK_ID.jsonl" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" >/dev/null && exit
[ "${SLURM_RESTART_COUNT:-0}" -lt 3 ] && scontrol requeue "$SLURM_JOB_ID"
exit 1'
job=$(sbatch --parsable --array="1-$parts" --requeue --open-mode=append --output=part%a.log \
    --wrap "set -- $(printf '%q ' "$@")$script")
sbatch --wait --dependency="afterok:$job" --kill-on-invalid-dep=yes --output=ranking.txt --wrap "svbrdf rank --merge 'part*.jsonl'"
cat ranking.txt
