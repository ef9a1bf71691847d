#!/usr/bin/env bash
# Measures what docs/performance.md shows: builds mane, mane without any SIMD and the twin, and runs them in turn.
#   scripts/bench.sh                                the whole of it, into bench/results/: hours
#   scripts/bench.sh --only core --runs 1 --frames 2 --preroll 2    as `mane bench` takes it
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/setup.sh

# shellcheck disable=SC2086
mane_install $mane_packages_build doctest-dev
for preset in release bench-scalar; do
    cmake --preset "$preset" >/dev/null
done
cmake --build build/release --target mane_command bench_twin bench_kernel
cmake --build --preset bench-scalar
[ $# -gt 0 ] || set -- --csv bench/results
exec build/release/tools/mane bench --plain-core build/bench-scalar/tools/mane --twin build/release/tests/runs/bench_twin \
    --kernel build/release/bench/bench_kernel --plain-kernel build/bench-scalar/bench/bench_kernel "$@"
