"""Solves the clamp of K06 (33) as a relay with Siconos. Runs under the system's Python, which has python3-siconos.

    /usr/bin/python3 siconos_relay.py CASES.npy ANSWERS.npy

CASES: rows f*, lower, upper [N]. One implicit Euler step of length 1 of x' = r from x = -f* with the multi-valued
relation -x(1) in N_[lower, upper](r) says: r = lower where x(1) > 0, upper where x(1) < 0, between where x(1) = 0.
That is (28): x(1) = f - f*, the motion of the proxy times D/T.
"""

import sys

import numpy as np
import siconos.kernel as sk


def solve(hold, lower, upper):
    """The friction force of one case [N]."""
    system = sk.FirstOrderLinearDS([-hold], [[0.0]])
    relation = sk.FirstOrderLinearTIR([[1.0]], [[1.0]])
    interaction = sk.Interaction(sk.RelayNSL(1, lower, upper), relation)
    model = sk.NonSmoothDynamicalSystem(0.0, 1.0)
    model.insertDynamicalSystem(system)
    model.link(interaction, system)
    stepping = sk.TimeStepping(model, sk.TimeDiscretisation(0.0, 1.0), sk.EulerMoreauOSI(1.0), sk.Relay())
    stepping.computeOneStep()
    return float(interaction.lambda_(0)[0])


if __name__ == "__main__":
    np.save(sys.argv[2], np.array([solve(*map(float, case)) for case in np.load(sys.argv[1])]))
