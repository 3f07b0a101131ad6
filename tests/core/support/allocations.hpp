// Counts every call to operator new in the test program (the operators stand in allocations.cpp).
#pragma once

#include <cstddef>

namespace punctura::test {
std::size_t allocations() noexcept;
}
