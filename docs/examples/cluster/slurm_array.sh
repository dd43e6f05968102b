#!/usr/bin/env bash
# Computes the meshes of a list as a Slurm array, a shard per task:
#   sbatch --array=1-COUNT slurm_array.sh COUNT LIST RESULTS [OPTIONS...]
# Each task is one process, which opens its device once. Repeating the call computes the missing results. COUNT is an
# argument because SLURM_ARRAY_TASK_COUNT differs when a part of the array is submitted again (--array=3,5).
#SBATCH --job-name=asdf-vk
#SBATCH --cpus-per-task=1
#SBATCH --output=asdf-vk-%A-%a.out
#SBATCH --open-mode=append
#SBATCH --requeue
# SIGTERM one to two minutes before the time limit. The program drops the mesh that it computes, or finishes writing it.
#SBATCH --signal=B:TERM@60
set -euo pipefail

count=$1 list=$2 results=$3
shift 3
case " $* " in *" --threads "* | *" --threads="*) ;; *) set -- --threads "${SLURM_CPUS_PER_TASK:-1}" "$@" ;; esac
mkdir -p "$results/log"
# exec: asdf-vk replaces the shell, which is the process that receives the signal.
exec asdf-vk --files-from "$list" --shard "$SLURM_ARRAY_TASK_ID/$count" -o "$results" --skip-existing --quiet \
  --log "$results/log/shard-$SLURM_ARRAY_TASK_ID.jsonl" "$@"
