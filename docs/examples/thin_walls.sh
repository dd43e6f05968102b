#!/usr/bin/env bash
# Lists the thin regions of meshes through pipes, without a file in between: thin_walls.sh LIMIT MESH...
# Needs asdf-vk and awk. Ends with 6 if a mesh is thinner than LIMIT, with 5 if one cannot be judged.
set -euo pipefail

limit=$1
shift
status=0
for mesh in "$@"; do
  # The result goes to standard output as CSV, a line per face; the second program keeps the faces below the limit.
  asdf-vk - -o - --format csv --fields least_thickness --fail-if-thinner "$limit" --quiet <"$mesh" |
    awk -F, -v limit="$limit" -v mesh="$mesh" \
      'NR > 1 && $2 < limit { count++ } END { printf "%s: %d faces thinner than %s\n", mesh, count, limit }' ||
    status=$?
done
exit "$status"
