"""What comes before the model: the 300 Hz low-pass of K06 section 4 (E5), and the direction from the motion."""

import numpy as np


def low_pass(p, rate, cut_off):
    """First-order low-pass with the exact gain for a held sample; starts at the first sample; cut_off 0 is off."""
    if cut_off == 0:
        return p.copy()
    gain = 1 - np.exp(-2 * np.pi * p.dtype.type(cut_off) / rate)
    out = p.copy()
    for k in range(1, len(p)):
        out[k] = out[k - 1] + gain * (p[k] - out[k - 1])
    return out


def motion_direction(p, rate, seconds=0.010, path=0.2e-3):
    """(ticks, 3) unit displacement over the last 10 ms, or over the last 0.2 mm of path if that is longer in time.

    p (ticks, 3) are filtered positions. Where the tip has not moved at all the direction is zero: it points nowhere.
    """
    walked = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))])
    out = np.zeros_like(p)
    for k in range(len(p)):
        by_time = k - round(seconds * rate)
        by_path = np.searchsorted(walked[: k + 1], walked[k] - path, side="right") - 1
        d = p[k] - p[max(min(by_time, by_path), 0)]
        length = np.linalg.norm(d)
        out[k] = d / length if length > 0 else 0
    return out
