#!/usr/bin/env bash
# Ranks a data set as a job array of Slurm: `slurm.sh gt/ ours/ theirs/`, in a folder that all nodes see, with PARTS (8) jobs.
# A part whose node fails is queued again. The last job computes what is missing then; its notes are in ranking.log.
set -euo pipefail
rank="svbrdf rank --dataset $(printf '%q ' "$@") --results losses"

job=$(sbatch --parsable --array="1-${PARTS:-8}" --requeue --open-mode=append --output=part%a.log \
    --wrap "$rank --shard \$SLURM_ARRAY_TASK_ID/\$SLURM_ARRAY_TASK_COUNT")
sbatch --wait --dependency="afterany:$job" --output=ranking.txt --error=ranking.log --wrap "$rank"
cat ranking.txt
