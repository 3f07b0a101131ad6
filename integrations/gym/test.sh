#!/usr/bin/env bash
# The scripts of this folder: hands learn to stop after a pop, the throughput is measured, and trials are compared.
source "$(dirname "$0")/../tools.sh"
with_package gymnasium "gymnasium>=1.1,<2"
mkdir -p "$work"
cd "$here"
"$python" train.py --task StopAfterPop --generations 3 --seconds 600 --test-patients 100 | tee "$work/log"
"$python" throughput.py --rounds 2
awk '/StopsAfterPop .*%/ { felt = $2 + 0 } /StopsAtDepth .*%/ { blind = $2 + 0 }
     END { if (felt < 80 || felt < blind + 20) { print "the hand has not learnt to stop after the pop"; exit 1 } }' \
  "$work/log"
echo "gym: a hand that feels the pop stops behind it"

# Stable-Baselines3 has PyTorch, which takes 5 GB.
with_package stable_baselines3 "stable-baselines3>=2.4,<3"
"$python" same_trials.py
"$python" ppo.py --decisions 50000 | tee "$work/log"
awk '/^PPO:/ { felt = $2 + 0 } END { if (felt < 40) { print "PPO has not learnt to stop after the pop"; exit 1 } }' \
  "$work/log"
