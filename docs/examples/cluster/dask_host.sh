#!/usr/bin/env bash
# Starts a part of a Dask cluster, whose hosts share a file system; stays in the foreground:
#   dask_host.sh scheduler FILE [OPTIONS...]       on one host; writes its address to FILE
#   dask_host.sh workers FILE COUNT [OPTIONS...]   on each host: COUNT processes, a mesh at a time each
# Every program that can connect to the port of the scheduler can run code as this user: keep the port in a trusted
# network, or use the --tls options of Dask.
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
