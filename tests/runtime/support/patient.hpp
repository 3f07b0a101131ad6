// Settings of a loop on a computer that may be busy.
#pragma once

#include "punctura_runtime/loop/servo_loop.hpp"

namespace punctura::test {

/// Silence ends a run after five deadlines: after a minute. A fake driver's thread may wait that long for a processor.
inline LoopSettings patient() {
  LoopSettings settings;
  settings.gate.deadline = 12;
  return settings;
}

}  // namespace punctura::test
