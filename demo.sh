#!/usr/bin/env bash
# Installs what is missing, builds mane, simulates the paper's long hair on the built-in character, checks the result, and leaves a
# page that plays it, one that simulates it live, a picture and the strands. Says where they are.
set -euo pipefail
cd "$(dirname "$0")"
source scripts/setup.sh

# shellcheck disable=SC2086
mane_install $mane_packages_build
# shellcheck disable=SC2086
(mane_install $mane_packages_live) || echo "without $mane_packages_live there will be no live page"
cmake --preset release -DMANE_TESTS=OFF >/dev/null
cmake --build --preset release

mane=build/release/tools/mane
mkdir -p out
"$mane" simulate scenes/long.toml -o out/long.mane --threads 0 --record
"$mane" check out/long.mane || echo "some criteria are not met: see the table above"
"$mane" picture out/long.mane --frame 96 -o out/long.png
"$mane" view out/long.mane -o out/long.html
"$mane" live -o out/live.html || echo "no live page: see above"
"$mane" extract out/long.mane --frame 96 --layer strands -o out/long.hair

echo
echo "the simulation:      out/long.mane   (build/release/tools/mane info out/long.mane)"
echo "a picture of it:     out/long.png"
echo "100,000 strands:     out/long.hair"
echo
echo "what was simulated, in a browser:     $PWD/out/long.html"
[ ! -f out/live.html ] || echo "hair to touch, open this in a browser: $PWD/out/live.html"
