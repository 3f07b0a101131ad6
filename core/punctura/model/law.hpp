// What a friction law gives: the door for K06's two laws and for those of other authors.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "punctura/model/piecewise_band.hpp"

namespace punctura {

/// A law gives the quadratic pieces of its band, a PiecewiseBand. Lower edge <= upper edge everywhere, both 0 before the first
/// break, both constant behind the last. The first break is at the surface, 0, or deeper.
template <typename L>
concept Law = requires(const L law, typename L::Scalar q) {
  typename L::Scalar;
  { law.pieces().band(q) } noexcept -> std::same_as<Band<typename L::Scalar>>;
};

/// A law whose pieces depend on the obliquity at which the needle enters, K06 (17).
template <typename L>
concept ObliqueLaw = Law<L> && requires(const L law, typename L::Scalar cos_beta) {
  { law.pieces(cos_beta) } noexcept -> std::same_as<std::remove_cvref_t<decltype(law.pieces())>>;
};

/// A law that remembers what the needle did to the membrane, such as the deepest point that it has cut. Memory{} stands for an
/// untouched membrane. The memory is kept until the proxy is reset, also while the needle is outside. (ServoStep::reset(), which
/// leaves a fault, resets it too.)
///
/// The memory is one for the whole membrane: it does not know where, nor at what angle, the needle entered. A needle that enters
/// beside an old hole finds the hole.
template <typename L>
concept LawWithMemory =
    requires(const L law, typename L::Memory& memory, typename L::Scalar cos_beta, typename L::Scalar depth) {
      requires std::is_trivially_copyable_v<typename L::Memory>;
      /// The proxy has come to this depth (m, along the needle), which is greater than 0. True where the pieces change by it.
      { law.advance(memory, depth) } noexcept -> std::same_as<bool>;
      { law.pieces(cos_beta, memory) } noexcept -> std::same_as<std::remove_cvref_t<decltype(law.pieces())>>;
      { law.pieces(memory) } noexcept -> std::same_as<std::remove_cvref_t<decltype(law.pieces())>>;  // on a line
    };

/// A law that has a Memory, or advances, must have all of it: else it would be taken for one without memory.
template <typename L>
constexpr bool memory_is_whole = LawWithMemory<L> || !(requires { typename L::Memory; } || requires { &L::advance; });

struct NoMemory {};
template <typename L>
struct MemoryOf {
  using type = NoMemory;
};
template <LawWithMemory L>
struct MemoryOf<L> {
  using type = typename L::Memory;
};

/// The pieces of a law, as its proxies hold them.
template <Law L>
using PiecesOf = std::remove_cvref_t<decltype(std::declval<const L&>().pieces())>;

}  // namespace punctura
