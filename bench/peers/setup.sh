#!/usr/bin/env bash
# The peers in a virtual environment of their own, build/peers: 2 GB, so not part of test.sh.
#   PYTHON=python3.11 bench/peers/setup.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
python=${PYTHON:-python3.11}
command -v "$python" >/dev/null || { echo "setup.sh: there is no $python here; set PYTHON to a Python 3.11" >&2; exit 1; }
[ -x build/peers/bin/python ] || "$python" -m venv build/peers
build/peers/bin/python -m pip install --quiet -r bench/peers/requirements.txt
