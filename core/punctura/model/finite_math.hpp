// Stops the compilation if options let the compiler assume that no number is NaN or infinite.
#pragma once

// The input gate and the last check before the device test numbers for NaN. -ffast-math removes these tests silently.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST)
#error \
    "Punctura cannot be compiled with -ffast-math, -ffinite-math-only or /fp:fast: they remove the NaN checks that " \
    "keep a wrong force from a hand. Remove the option from files that include Punctura."
#endif
