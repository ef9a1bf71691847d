#!/usr/bin/env bash
# Makes the pictures of README.md, docs/view.md and docs/live.md: the layers, the styles, a strip of frames and the pages of
# `mane view` and `mane live`, all drawn by those pages.
set -euo pipefail
cd "$(dirname "$0")/.."
mane=build/release/tools/mane
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for style in short medium long; do
    "$mane" simulate "scenes/$style.toml" -o "$work/$style.mane" --threads 0 --record >/dev/null
    "$mane" view "$work/$style.mane" -o "$work/$style.html" >/dev/null
done
"$mane" live -o "$work/live.html"
node viewer/pictures.mjs "$work" docs/images
