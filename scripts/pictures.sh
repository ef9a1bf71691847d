#!/usr/bin/env bash
# Makes the pictures of README.md: the three styles in motion, and the three layers of one frame.
set -euo pipefail
cd "$(dirname "$0")/.."
mane=build/release/tools/mane
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for style in short medium long; do
    "$mane" simulate "scenes/$style.toml" -o "$work/$style.mane" --frames 200 --threads 0 >/dev/null
    "$mane" picture "$work/$style.mane" --frame 0 110 150 199 --view three-quarter --size 300 --samples 32 --height 0.62 \
        -o "docs/images/$style.png"
done
for layer in skeleton envelope strands; do
    "$mane" picture "$work/long.mane" --frame 199 --view three-quarter --layer "$layer" --size 400 --samples 32 --height 0.62 \
        $([ "$layer" = strands ] || echo --colour-by-wisp) -o "docs/images/layer-$layer.png"
done
