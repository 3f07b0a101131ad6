// The parsers of the Inverse Service's messages under libFuzzer: tools/fuzz.sh.
#include <cstdint>

#include "fuzz/haply_inputs.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  punctura::test::read_anything({reinterpret_cast<const char*>(data), size});
  return 0;
}
