#!/usr/bin/env bash
# Makes the pictures of README.md and docs/view.md: the layers, the styles, a strip of frames and the page of `mane view`, all
# drawn by that page itself.
set -euo pipefail
cd "$(dirname "$0")/.."
mane=build/release/tools/mane
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for style in short medium long; do
    "$mane" simulate "scenes/$style.toml" -o "$work/$style.mane" --threads 0 --record >/dev/null
    "$mane" view "$work/$style.mane" -o "$work/$style.html" >/dev/null
done
node viewer/pictures.mjs "$work" docs/images
