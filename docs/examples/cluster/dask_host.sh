#!/usr/bin/env bash
# Starts a part of a Dask cluster, whose hosts share a file system; stays in the foreground:
#   dask_host.sh scheduler FILE [OPTIONS...]       on one host; writes its address to FILE
#   dask_host.sh workers FILE COUNT [OPTIONS...]   on each host: COUNT processes, a mesh at a time each
# Whoever reaches the scheduler's port runs code as this user: keep it in a trusted network, or use its --tls options.
set -euo pipefail

part=$1 file=$2
shift 2
case $part in
  scheduler)
    rm -f "$file" # Workers wait for the file; an old one has the address of an old scheduler.
    exec dask scheduler --scheduler-file "$file" --no-dashboard "$@"
    ;;
  workers)
    count=$1
    shift
    until [ -s "$file" ]; do sleep 0.2; done
    exec dask worker --scheduler-file "$file" --nworkers "$count" --nthreads 1 --no-dashboard "$@"
    ;;
esac
