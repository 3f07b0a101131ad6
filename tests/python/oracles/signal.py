"""Processing before the model: the low-pass of K06 section 4 (E5), the line fit, the direction from the motion."""

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


def line_fit(p, rate, step):
    """(ticks,) one axis: a line over the last 15 ms or half, a quarter ... of it, then 200 Hz, then a play.

    The samples scatter around a line by at most 1.1 steps rms, and its end is within two steps of the newest sample.
    Below a step of 0.055 mm both times shrink with the square root of the step. The line is extrapolated beyond the
    newest sample by the delay of the low-pass for a steady motion. The play is 0.4 steps.
    """
    share = min(1.0, step / 0.055e-3) ** 0.5
    lag = 1 / (1 - np.exp(-2 * np.pi * 200 / share / rate)) - 1
    seen = np.concatenate([np.full(200, p[0]), p])
    out = np.empty(len(p))
    for k in range(200, len(seen)):
        out[k - 200] = seen[k]
        n = 2 * max(1, int(0.015 * share / (2 * (1 / rate)) + 0.5)) + 1
        while n >= 3:
            t = np.arange(1 - n, 1)
            slope, end = np.polyfit(t, seen[k - n + 1 : k + 1], 1)
            scatter = ((end + slope * t - seen[k - n + 1 : k + 1]) ** 2).mean() ** 0.5
            if scatter <= 1.1 * step and abs(end - seen[k]) <= 2 * step:
                out[k - 200] = end + lag * slope
                break
            n = n // 2 | 1  # always odd
    smooth = low_pass(out, rate, 200.0 / share)
    for k in range(1, len(smooth)):
        smooth[k] = np.clip(smooth[k - 1], smooth[k] - 0.2 * step, smooth[k] + 0.2 * step)
    return smooth


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
