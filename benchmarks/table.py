"""Prints the measurements as text."""

from collections.abc import Iterator
from typing import Any

from ratios import Ratio

NAMES = ("fused", "paper", "exact")
SHARES = ("outside", "sticking", "sliding_in", "sliding_out")


def time(timing: dict[str, float] | None) -> str:
    """Median and half of the interquartile range, ns."""
    if timing is None:
        return ""
    half = (timing["upper_quartile_ns"] - timing["lower_quartile_ns"]) / 2
    digits = 1 if timing["median_ns"] < 1000 else 0
    return f"{timing['median_ns']:.{digits}f} ±{half:.{digits}f}"


def over(timing: dict[str, Any]) -> str:
    return f"{timing['over_fused']['median']:.2f}" if "over_fused" in timing else ""


def table(result: dict[str, Any]) -> Iterator[str]:
    machine = result["machine"]
    load = "unknown" if machine["load"] is None else f"{machine['load']:.1f}"
    yield f"{machine['processor']}, {machine['cores']} cores, load {load}; {machine['system']}"
    yield f"{result['compiler']}, {result['flags']}; " + ", ".join(f"{k} {v}" for k, v in result["versions"].items())
    yield ""
    yield "The work: how the proxies spent their ticks (exact solver)"
    for work in result["work"]:
        shares = ", ".join(f"{k.replace('_', ' ')} {work[k]:.0%}" for k in SHARES)
        yield f"  {work['membranes']:3} membranes, {work['motion']:8} {shares}"
    yield ""
    yield "ns per tick: median of interleaved rounds, in processor time, ± half of the interquartile range"
    yield (
        f"  {'form':11} {'scalar':7} {'membranes':9} {'motion':8}"
        + "".join(f"{n:>14}" for n in NAMES)
        + (f"{'paper/fused':>13}{'exact/fused':>13}")
    )
    for row in result["rows"]:
        timings = row["contestants"]
        yield (
            f"  {row['form']:11} {row['scalar']:7} {row['membranes']:9} {row['motion']:8}"
            + "".join(f"{time(timings.get(name)):>14}" for name in NAMES)
            + "".join(f"{over(timings[name]):>13}" for name in NAMES[1:])
        )
    for row in result["tissue"]:
        yield (
            f"  {row['form']:11} {'double':7} {1:9} {row['motion']:9} {row['solver']}: K06 {row['k06_ns']:.1f}, "
            f"tissue with 8 knots, cutting and a set {row['tissue_ns']:.1f}"
        )
    for name, timing in result["loops"].items():  # with the work of the first row
        yield f"  {'1-D':11} {'double':7} {1:9} {'encoder':8}  {name} loop: {time(timing)}"


def wakeup_table(wakeups: dict[str, Any]) -> Iterator[str]:
    priority = wakeups["priority"]
    how = f"SCHED_FIFO real-time priority {priority}" if priority else "no real-time priority (not granted)"
    where = ", ".join(str(processor) for processor in wakeups["processors"])
    yield f"Wake-up latency at {wakeups['rate_hz']:g} Hz, {how}, on each processor in turn ({where}), us"
    heads = "".join(f"{head:>10}" for head in ("median", "99 %", "99.9 %", "largest"))
    yield f"  {'':14} {'':10}{heads}"
    for row in wakeups["conditions"]:
        for name in ("loop", "cyclictest"):
            if name in row:
                values = (row[name][key] for key in ("p50_us", "p99_us", "p99_9_us", "largest_us"))
                after = f"   {row[name]['missed']} of {row[name]['wake_ups']} skipped" if name == "loop" else ""
                yield f"  {row['name']:14} {name:10}" + "".join(f"{v:10.1f}" for v in values) + after
        if row.get("stolen_s"):
            yield f"  {'':14} virtual machine: the host took {row['stolen_s']:.2f} s of processor time"
    if wakeups["cyclictest"] is None:
        yield "  cyclictest is missing, so there is no comparison. On Debian and Ubuntu install the package rt-tests."


def verdicts(ratios: list[Ratio], of: str = "One tick, one membrane: median") -> Iterator[str]:
    yield f"{of} [quartiles]"
    for r in ratios:
        digits = 2 if r.value < 100 else 0
        quartiles = f"[{r.lower_quartile:.{digits}f}, {r.upper_quartile:.{digits}f}]"
        yield f"  {'PASS' if r.passes else 'MISS'}  {r.what:38} {r.value:8.{digits}f} {quartiles:16} {r.target}"
