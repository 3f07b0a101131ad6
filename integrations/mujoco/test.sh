#!/usr/bin/env bash
# punctura.mujoco with MuJoCo itself: stability, momentum, state, wrong use, threads, 60 s at rest, the example's robot.
source "$(dirname "$0")/../tools.sh"
with_package mujoco "mujoco>=4,<5"
cd "$here"
PYTHONPATH=$here PUNCTURA_LONG=1 "$python" -m pytest -q -p no:cacheprovider .
