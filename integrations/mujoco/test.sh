#!/usr/bin/env bash
# punctura.mujoco with MuJoCo itself: stability, momentum, state, wrong use, threads, 60 s at rest, the robot of the example.
source "$(dirname "$0")/../tools.sh"
with_package mujoco "mujoco>=4,<5"
cd "$here"
PYTHONPATH=$here PUNCTURA_LONG=1 "$python" -m pytest -q -p no:cacheprovider test_mujoco.py test_threads.py test_wrong_use.py
