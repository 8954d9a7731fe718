#!/usr/bin/env bash
# Installs the packages that scripts/package has made, uses them as others would, removes them, and looks for what stays.
# Called by scripts/try-in-bare-root within the root; on a machine that is used for something else it would change it.
set -euo pipefail
lib=$(dirname -- "$(readlink -f -- "$0")")
# shellcheck source=common.sh
source "$lib/common.sh"

[[ ${PARKING_IN_BARE_ROOT:-} == yes ]] || die "is called by scripts/try-in-bare-root, within the root that it makes"
export DEBIAN_FRONTEND=noninteractive
work=$(mktemp --directory)
traces()
{
    # In /var/cache are the pages that man has formatted.
    find / -xdev '(' -path /project -o -path /proc -o -path /cache -o -path /var/cache -o -path "$work" ')' -prune -o \
        '(' -name '*improved*astar*' -o -name '*parking_*' -o -name 'libparking*' ')' -print | sort
}

before=$(traces)
cp -- "$project_root"/build/package/packages/*.deb "$work"
apt-get --quiet --quiet install --yes --no-install-recommends "$work"/*.deb g++ cmake make pkg-config man-db >/dev/null
cd -- "$work"
say "The programs"
parking_plan /usr/share/ompl_improved_astar/scenarios/narrow_parallel.yaml --json plan.json --svg plan.svg
grep -q '"status":"exact"\|"status": "exact"' plan.json
parking_benchmark /usr/share/ompl_improved_astar/bundled.cfg --planner improved_astar --runs 1 --quiet --no-report \
    --output results >/dev/null
[[ -s results/benchmark.db ]]
for program in parking_plan parking_benchmark; do
    man --pager=cat --warnings "$program" 2>man-warnings >page
    [[ ! -s man-warnings ]] && grep -q -- '--help' page
done
say "The Python module"
python3 - /usr/share/ompl_improved_astar/scenarios/narrow_parallel.yaml <<'PYTHON'
import sys
import improved_astar as ia
result = ia.plan(ia.Scenario.read(sys.argv[1]))
assert result and ia.check(result.scenario, result), result
assert ia.__file__.startswith('/usr/lib/python3/dist-packages/'), ia.__file__
loaded = open('/proc/self/maps', encoding='utf-8').read()
assert not any(name in loaded for name in ('libompl.so', 'libfcl', 'libceres')), 'more than the core is loaded'
PYTHON
say "Other people's projects"
consumers=$project_root/tests/package
cmake -S "$consumers/consumer" -B consumer -DPROJECT_FOLDER="$project_root" -DLIBRARIES="" >/dev/null
cmake --build consumer --target plan_parking >/dev/null
./consumer/plan_parking >/dev/null
cmake -S "$consumers/core_consumer" -B core_consumer -DCOMPONENTS=core >/dev/null
cmake --build core_consumer >/dev/null
./core_consumer/plan_without_ompl
# What pkg-config prints is meant to be split into words.
# shellcheck disable=SC2046
g++ -std=c++17 "$project_root/examples/readme_example.cpp" -o by_pkg_config \
    $(pkg-config --cflags --libs ompl_improved_astar)
./by_pkg_config >/dev/null
say "Removing them"
apt-get --quiet --quiet purge --yes ompl-improved-astar ompl-improved-astar-doc libompl-improved-astar-dev \
    python3-improved-astar 'libompl-improved-astar0*' >/dev/null
cd /
after=$(traces)
if [[ $after != "$before" ]]; then
    diff <(printf '%s\n' "$before") <(printf '%s\n' "$after") || true
    say "FAILED: files stay behind"
    exit 1
fi
rm -rf -- "$work"
say "Installed, used, removed: nothing stays behind"
