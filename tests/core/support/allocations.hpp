// Counts the calls of operator new in the test program. allocations.cpp replaces the operators.
#pragma once

#include <cstddef>

namespace punctura::test {
std::size_t allocations() noexcept;
}
