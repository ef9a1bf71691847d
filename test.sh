#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests. The last line counts them.
#   ./test.sh          everything
#   ./test.sh --quick  the release build's tests alone
set -euo pipefail
cd "$(dirname "$0")"
source scripts/setup.sh

# shellcheck disable=SC2086
mane_install $mane_packages_build $mane_packages_test
log=$(mktemp) build_log=$(mktemp)
trap 'rm -f "$log" "$build_log"' EXIT

# The tests of one preset: built, then run with their whole output kept for counting.
run_preset() {
    echo "== $1"
    cmake --preset "$1" >/dev/null
    cmake --build --preset "$1" >"$build_log" || { cat "$build_log"; exit 1; }
    grep -E 'warning:' "$build_log" || true
    ctest --preset "$1" -V >>"$log" 2>&1 || failed_presets+=("$1")
}

failed_presets=()
run_preset release
if [ "${1:-}" != --quick ]; then
    run_preset asan-ubsan
    run_preset tsan
    run_preset wasm
    # shellcheck disable=SC2086
    if (mane_install $mane_packages_neon); then run_preset neon
    elif [ "${CI:-}" = true ]; then failed_presets+=(neon)
    else echo "skipped: neon: $mane_packages_neon cannot be installed here" | tee -a "$log"; fi
    echo "== format"
    if ! git ls-files '*.cpp' '*.h' | xargs clang-format-14 --dry-run --Werror; then failed_presets+=(format); fi
fi

# doctest counts its cases; what is not doctest counts as one test each.
passed=$(grep -oE 'test cases: +[0-9]+ \| +[0-9]+ passed' "$log" | awk '{n += $5} END {print n + 0}')
failed=$(grep -oE '\| +[0-9]+ failed \|.*skipped' "$log" | grep -v assertions | awk '{n += $2} END {print n + 0}')
other_failed=$(grep -cE '^ *[0-9]+/[0-9]+ Test.*(Failed|Timeout|Not Run|Exception)' "$log" || true)
other_passed=$(grep -cE '^([0-9]+: )?script test passed' "$log" || true)
skipped=$(grep -cE 'skipped: ' "$log" || true)
[ "$failed" -ge "$other_failed" ] || failed=$other_failed
if [ ${#failed_presets[@]} -gt 0 ]; then
    grep -E 'ERROR|FATAL|values:|TEST CASE|\*\*\*' "$log" | tail -n 80 || true
    echo "failed: ${failed_presets[*]}"
    [ "$failed" -gt 0 ] || failed=${#failed_presets[@]}
fi
echo "$((passed + other_passed)) passed, $failed failed, $skipped skipped"
[ ${#failed_presets[@]} -eq 0 ]
