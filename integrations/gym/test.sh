#!/usr/bin/env bash
# Stable-Baselines3, which has PyTorch (5 GB): the trials of its learners are those of make_vec_env, and PPO learns.
source "$(dirname "$0")/../tools.sh"
with_package stable_baselines3 "stable-baselines3>=2.4,<3"
mkdir -p "$work"
cd "$here"
"$python" same_trials.py
"$python" ppo.py --decisions 50000 | tee "$work/log"
awk '/^PPO:/ { felt = $2 + 0 } END { if (felt < 40) { print "PPO has not learnt to stop after the pop"; exit 1 } }' \
  "$work/log"
