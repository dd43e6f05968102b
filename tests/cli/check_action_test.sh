#!/usr/bin/env bash
# Runs the script of the action .github/actions/check on a thin and on a thick part.
#   check_action_test.sh SCRIPT FOLDER_OF_PROGRAMS
set -euo pipefail

script=$1
PATH=$2:$PATH
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
  echo "check_action_test: $*" >&2
  exit 1
}

mkdir "$folder/my parts"
asdf-vk-generate thin-wedge -o "$folder/my parts/thin.ply" >/dev/null
asdf-vk-generate thick-cube -o "$folder/my parts/thick.ply" >/dev/null
cd "$folder"
export ASDF_VK_FILES=$'my parts\n' GITHUB_STEP_SUMMARY=$folder/summary.md
check() { ASDF_VK_LIMIT=0.8 "$script" 2>errors; }

code=0
ASDF_VK_SARIF=walls.sarif ASDF_VK_OPTIONS=$'--count-edges\n--jobs=1' check >output || code=$?
[ "$code" -eq 6 ] || fail "exit code $code instead of 6: $(cat errors)"
grep -q '^::error file=my parts/thin.ply,title=thinWall::wall of 0.3' output || fail "no annotation: $(cat output)"
grep -q '"ruleId": "thinWall"' walls.sarif || fail "no result in SARIF"
grep -q '1 ok, 1 thin' summary.md || fail "no summary: $(cat summary.md)"

asdf-vk -r "my parts" --fail-if-thinner 0.8 --baseline walls.json --update-baseline 2>/dev/null
ASDF_VK_BASELINE=walls.json check >output || fail "a known place fails: $(cat errors)"
! grep -q '^::error' output || fail "a known place is an error: $(cat output)"

echo '{"limits": [{"files": "thin.ply", "fail-if-thinner": 0.2}]}' >limits.json
ASDF_VK_LIMITS=limits.json check >output || fail "the limit of a mesh is not used: $(cat errors)"

code=0
ASDF_VK_FILES=missing check >output || code=$?
[ "$code" -eq 2 ] || fail "exit code $code instead of 2 for a missing folder: $(cat errors)"
