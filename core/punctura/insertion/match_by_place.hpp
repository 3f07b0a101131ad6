// After a change of scene, each membrane continues from the one at the same place.
#pragma once

#include <algorithm>
#include <cstddef>

namespace punctura {

/// Calls resume(now[i], before[j]) for each pair of elements at the same place (`same_place`). If several elements
/// share a place, they are paired in their order. An element at a new place has no pair. It allocates no memory.
template <typename Now, typename Before, typename Resume>
void match_by_place(Now& now, const Before& before, Resume&& resume) noexcept {
  for (auto one = now.begin(); one != now.end(); ++one) {
    const auto here = [&](const auto& other) { return one->same_place(other); };
    auto skip = std::count_if(now.begin(), one, here);
    for (const auto& old : before)
      if (here(old) && skip-- == 0) {
        resume(*one, old);
        break;
      }
  }
}

}  // namespace punctura
