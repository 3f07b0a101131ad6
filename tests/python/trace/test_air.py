"""Contact, zero and drift come from the air in front of the tissue and behind it."""

import numpy as np
import pytest
from punctura import Membrane
from punctura.trace import Trace, segment
from punctura.trace.findings import examine
from traces import force_of, motion

NOISE = 8e-3
SOFT = Membrane(stiffness=250, precompression=0.1, friction=0.3, thickness=0.3e-3)
FIRM = Membrane(stiffness=2500, precompression=0.6, friction=0.3, thickness=0.5e-3)


def layers(seed=1, change=0.0):
    """A soft layer at 2 mm and a firm wall at 9 mm, with time; change: of the zero over the trace, N."""
    time, depth = motion(deepest=18e-3)
    force = force_of(depth, 2e-3, SOFT) + force_of(depth, 9e-3, FIRM)
    force += change * np.linspace(0, 1, len(time)) + NOISE * np.random.default_rng(seed).normal(size=len(time))
    return Trace(depth, force, time)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_contact_is_where_a_soft_layer_begins_and_its_force_is_no_offset(seed):
    made = examine(layers(seed))
    assert not {one.kind for one in made.findings} & {"offset", "drift"}
    found = segment(made)
    assert made.depth[found.contact] == pytest.approx(2e-3, abs=0.4e-3)
    assert made.force[made.depth < 1e-3].mean() == pytest.approx(0, abs=3e-3)
    assert made.depth[found.exit] < 9e-3 and np.abs(made.force[found.exit :]).max() < 5 * NOISE


def test_every_tenth_sample_gives_the_same_contact():
    made = layers()
    few = made[::10]
    assert few.depth[segment(few).contact] == pytest.approx(made.depth[segment(made).contact], abs=0.5e-3)


def test_a_zero_that_has_changed_behind_the_tissue_is_a_drift():
    made = examine(layers(change=0.4))
    assert [one.kind for one in made.findings if one.kind == "drift"] == ["drift"]
    assert made.depth[segment(made).contact] < 9.5e-3


def test_a_needle_that_stays_in_the_tissue_has_no_exit():
    made = layers()
    for end in (5.5, 6.2):  # s: on the way out, but deeper than the firm wall
        assert segment(made[made.time < end]).exit is None


def test_a_spike_in_air_is_no_contact():
    made = layers()
    force = made.force.copy()
    force[20] += 1.0
    contact = segment(Trace(made.depth, force, made.time)).contact
    assert made.depth[contact] == pytest.approx(2e-3, abs=0.4e-3)
