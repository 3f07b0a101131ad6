"""Runs knob.elf in Unicorn, an emulator of processors, and compares its forces with the desktop's float.

python run.py cortex-m4f|riscv32 knob.elf libknob.so NM-OUTPUT
"""

import ctypes
import struct
import sys
from pathlib import Path

import numpy as np
from processors import PROCESSORS, Processor
from unicorn import UC_HOOK_CODE, Uc

RETURN = 0x30000000  # where a function returns to
MEMORY = 0x40000


def load(uc: Uc, elf: bytes) -> None:
    """Writes the loadable segments of a 32-bit ELF file into the memory of the emulator."""
    (offset,), (size, count) = struct.unpack_from("<I", elf, 28), struct.unpack_from("<HH", elf, 42)
    for i in range(count):
        kind, at, _, to, stored = struct.unpack_from("<5I", elf, offset + i * size)
        if kind == 1 and stored:
            uc.mem_write(to, elf[at : at + stored])


class Board:
    def __init__(self, processor: Processor, elf: bytes, symbols: dict[str, int]) -> None:
        self.processor, self.symbols, self.instructions = processor, symbols, 0
        self.uc = processor.start()
        for start in (0, 0x20000000, RETURN):
            self.uc.mem_map(start, MEMORY)
        load(self.uc, elf)
        self.uc.hook_add(UC_HOOK_CODE, self.count)

    def count(self, *_: object) -> None:
        self.instructions += 1

    def call(self, name: str, number: float = 0) -> tuple[float, int]:
        """(result, instructions) of a function with one float in and one out."""
        registers, uc = self.processor, self.uc
        uc.reg_write(registers.stack, 0x20000000 + MEMORY - 16)
        uc.reg_write(registers.link, RETURN | registers.mode_bit)
        (bits,) = struct.unpack("<I", struct.pack("<f", number))
        uc.reg_write(registers.argument, registers.boxed(bits))
        before = self.instructions
        uc.emu_start(self.symbols[name] | registers.mode_bit, RETURN)
        bits = uc.reg_read(registers.argument)
        return struct.unpack("<f", struct.pack("<I", bits & 0xFFFFFFFF))[0], self.instructions - before


def main() -> None:
    elf, desktop = Path(sys.argv[2]).read_bytes(), ctypes.CDLL(sys.argv[3])
    rows = [line.split() for line in Path(sys.argv[4]).read_text().splitlines()]
    symbols = {row[-1]: int(row[0], 16) for row in rows if len(row) == 3}
    heap = {"malloc", "_malloc_r", "free", "_Znwj", "_ZdlPv", "_sbrk"} & symbols.keys()
    assert not heap, f"the program has a heap: {heap}"
    desktop.knob_tick.argtypes, desktop.knob_tick.restype = [ctypes.c_float], ctypes.c_float
    desktop.knob_setup()
    board = Board(PROCESSORS[sys.argv[1]], elf, symbols)
    board.call("knob_setup")
    t = np.arange(3200) / 1600
    depths = (6e-3 * np.sin(np.pi * t) - 1e-3 + 2e-5 * np.sin(400 * t)).astype(np.float32)
    depths = np.append(depths, [np.nan, np.inf]).astype(np.float32)
    ticks = [board.call("knob_tick", float(depth)) for depth in depths]
    forces = np.array([force for force, _ in ticks], np.float32)
    counts = np.array([count for _, count in ticks])
    expected = np.array([desktop.knob_tick(depth) for depth in depths], np.float32)
    assert np.isnan(forces[-2:]).all() and np.isnan(expected[-2:]).all()
    forces, expected = forces[:-2], expected[:-2]
    error = np.abs(forces.astype(float) - expected).max()
    assert np.ptp(expected) > 0.5 and error < 1e-6, error
    print(f"largest difference {error:.1e} N, {np.count_nonzero(forces != expected)} of {len(forces)} forces differ")
    print(f"instructions a tick: {counts.mean():.0f} on average, {counts.max()} at most")


if __name__ == "__main__":
    main()
