"""Traces of other rigs: forces of any size, and a start in the tissue."""

from dataclasses import replace

import numpy as np
import pytest
from punctura.identify import identify
from punctura.trace.findings import examine
from traces import NEEDLE, trace


@pytest.mark.parametrize("size", [1e-3, 800.0])  # a microneedle, and a trocar of 500 N
def test_a_force_of_any_size_gives_the_same_membranes(size):
    made = trace(noise=0.01)
    found = identify(replace(made, force=made.force * size), NEEDLE, membranes=1)
    for estimate, usual in zip(found.estimates, identify(made, NEEDLE, membranes=1).estimates, strict=True):
        factor = size if estimate.unit in ("N", "N/m") else 1
        numbers = (estimate.value, estimate.low, estimate.high)
        assert numbers == pytest.approx(np.multiply((usual.value, usual.low, usual.high), factor), rel=0.02), usual.name


def test_a_trace_that_begins_in_the_tissue_has_the_same_membrane():
    made = trace(noise=0.01)
    found = identify(made[int(np.argmax(made.depth > 6e-3)) :], NEEDLE)
    assert len(found.parameters.membranes) == 1 and found.fit.rmse == pytest.approx(0.01, rel=0.1)
    truth = {"membrane[0].surface": 5e-3, "membrane[0].stiffness": 600, "membrane[0].friction": 0.2}
    values = {estimate.name: estimate.value for estimate in found.estimates}
    assert [values[name] for name in truth] == pytest.approx(list(truth.values()), rel=0.1)


@pytest.mark.parametrize(
    "measured", [lambda force: np.minimum(force, 0.7 * force.max()), lambda force: np.maximum(force, 0)]
)
def test_a_force_beyond_the_range_of_its_sensor_is_left_out_of_the_fit(measured):
    made = trace(hold=0.4)
    read = examine(replace(made, force=measured(made.force)))
    found = identify(read, NEEDLE)
    assert len(found.parameters.membranes) == 1 and len(read) < len(made) and found.doubts.explained.ok
    truth = {"surface": 5e-3, "stiffness": 600, "precompression": 0.3, "friction": 0.2, "thickness": 0.5e-3}
    values = {estimate.name: estimate.value for estimate in found.estimates}
    assert [values[f"membrane[0].{name}"] for name in truth] == pytest.approx(list(truth.values()), rel=0.05)
