"""The emulated processors: how to start each, and the registers of its calling convention."""

from dataclasses import dataclass

from unicorn import UC_ARCH_ARM, UC_ARCH_RISCV, UC_MODE_MCLASS, UC_MODE_RISCV32, UC_MODE_THUMB, Uc
from unicorn import arm_const as arm
from unicorn import riscv_const as riscv


@dataclass(frozen=True)
class Processor:
    architecture: int
    mode: int
    model: int
    floating_point: tuple[int, int]  # register and value that switch the floating-point unit on
    stack: int
    link: int
    argument: int  # of the first float, and of a returned float
    mode_bit: int  # set in the address of a Thumb function
    nan_boxed: bool  # a float fills a wider register: the upper bits are ones

    def start(self) -> Uc:
        uc = Uc(self.architecture, self.mode)
        uc.ctl_set_cpu_model(self.model)
        uc.reg_write(*self.floating_point)
        return uc

    def boxed(self, bits: int) -> int:
        return bits | 0xFFFFFFFF00000000 if self.nan_boxed else bits


PROCESSORS = {
    "cortex-m4f": Processor(
        architecture=UC_ARCH_ARM,
        mode=UC_MODE_THUMB | UC_MODE_MCLASS,
        model=arm.UC_CPU_ARM_CORTEX_M4,
        floating_point=(arm.UC_ARM_REG_FPEXC, 0x40000000),
        stack=arm.UC_ARM_REG_SP,
        link=arm.UC_ARM_REG_LR,
        argument=arm.UC_ARM_REG_S0,
        mode_bit=1,
        nan_boxed=False,
    ),
    "riscv32": Processor(
        architecture=UC_ARCH_RISCV,
        mode=UC_MODE_RISCV32,
        model=riscv.UC_CPU_RISCV32_ANY,
        floating_point=(riscv.UC_RISCV_REG_MSTATUS, 0x6000),
        stack=riscv.UC_RISCV_REG_SP,
        link=riscv.UC_RISCV_REG_RA,
        argument=riscv.UC_RISCV_REG_FA0,
        mode_bit=0,
        nan_boxed=True,
    ),
}
