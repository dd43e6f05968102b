#!/usr/bin/env bash
# Computes the meshes of a list on hosts that share a file system, with GNU parallel over ssh, a shard per process:
#   parallel_hosts.sh HOSTS COUNT LIST RESULTS [OPTIONS...]
# HOSTS has a line N/HOST per host, N processes at a time; the line N/: is this host without ssh. COUNT shards: several
# times the number of processes, so that fast hosts get more of them. The same call again computes what is missing:
# parallel's own --resume is not used, because it skips finished shards even if the list has grown.
set -euo pipefail

hosts=$1 count=$2 list=$3 results=$4
shift 4
case " $* " in *" --threads "* | *" --threads="*) ;; *) set -- --threads 1 "$@" ;; esac
mkdir -p "$results/log"
# --workdir: relative paths have the same meaning on all hosts. --quote: so have spaces.
seq "$count" | parallel --sshloginfile "$hosts" --workdir "$PWD" --joblog "$results/log/parallel.tsv" --quote \
  asdf-vk --files-from "$list" --shard "{}/$count" -o "$results" --skip-existing --quiet \
  --log "$results/log/shard-{}.jsonl" "$@"
