"""Measures batches alone, against the core tick by tick. ./bench has the same rows.

python benchmarks/batches.py [--json FILE] [--pictures FOLDER] [--seconds S] [--program FILE]

docs/performance.md has the figures.
"""

import argparse
import json
import sys
from pathlib import Path

from batch_rows import batch_table, measure_batches
from pictures import draw
from program import ROOT, ProgramError, build
from run import machine, versions


def main() -> int:
    parser = argparse.ArgumentParser(description="Measures batches against the scalar core.")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all results and the machine's data")
    parser.add_argument("--pictures", type=Path, metavar="FOLDER", help="draw the results as SVG files")
    parser.add_argument("--seconds", type=float, default=4, help="seconds for each row (default %(default)s)")
    parser.add_argument("--program", type=Path, metavar="FILE", help="bench_batch, if it is already built")
    options = parser.parse_args()
    try:
        program = options.program or build(ROOT / "build/bench", "bench_batch")
        batch = measure_batches(program, options.seconds)
    except ProgramError as error:
        print(error, file=sys.stderr)
        return 3
    print("\n".join(batch_table(batch)))
    if options.json:
        result = {"machine": machine(), "versions": versions(), "batch": batch}
        options.json.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    if options.pictures:
        draw(batch, options.pictures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
