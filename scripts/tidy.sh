#!/usr/bin/env bash
# Looks for faults in src/ and tools/ with clang-tidy (.clang-tidy): all files, or those given. Five minutes of one core, so not a part of test.sh.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/setup.sh

# shellcheck disable=SC2086
mane_install $mane_packages_build clang-tidy-14
cmake --preset release >/dev/null
[ $# -gt 0 ] || mapfile -t files < <(git ls-files 'src/*.cpp' 'tools/*.cpp')
[ $# -eq 0 ] || files=("$@")
# GCC's own warning options, which are in the build's commands, mean nothing to it.
if printf '%s\n' "${files[@]}" |
    xargs -P "$(nproc)" -n 4 clang-tidy-14 -p build/release --quiet --extra-arg=-Wno-unknown-warning-option 2>/dev/null; then
    echo "tidy: ${#files[@]} files without findings"
else
    echo "tidy: findings above"
    exit 1
fi
