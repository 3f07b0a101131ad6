// The requirements on a friction law: the two laws of K06, or a law of your own.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "punctura/model/piecewise_band.hpp"

namespace punctura {

/// A friction law. Its pieces() are the quadratic pieces of its band, a PiecewiseBand.
///
/// The lower edge is <= the upper edge and <= 0 at every depth: a positive one would pull the needle in. Both edges are
/// 0 in front of the first break and constant behind the last finite break. The first break is at the surface (depth 0)
/// or deeper.
///
/// pieces(cos_beta) alone is enough: pieces() is for a line along the normal. A law with memory may have
/// pieces(cos_beta, memory) alone: Memory{} is an untouched membrane.
template <typename L>
concept Law = requires(const L law, typename L::Scalar q) {
  { law.pieces().band(q) } noexcept -> std::same_as<Band<typename L::Scalar>>;
} || requires(const L law, typename L::Scalar q) {
  { law.pieces(q).band(q) } noexcept -> std::same_as<Band<typename L::Scalar>>;
} || requires(const L law, typename L::Scalar q, const typename L::Memory& memory) {
  { law.pieces(q, memory).band(q) } noexcept -> std::same_as<Band<typename L::Scalar>>;
};

namespace detail {
template <Law L>
struct GivenPieces {
  using Type =
      decltype(std::declval<const L&>().pieces(typename L::Scalar(1), std::declval<const typename L::Memory&>()));
};
template <Law L>
  requires requires(const L& law) { law.pieces(); }
struct GivenPieces<L> {
  using Type = decltype(std::declval<const L&>().pieces());
};
template <Law L>
  requires(
      !requires(const L& law) { law.pieces(); } && requires(const L& law) { law.pieces(typename L::Scalar(1)); })
struct GivenPieces<L> {
  using Type = decltype(std::declval<const L&>().pieces(typename L::Scalar(1)));
};
}  // namespace detail
template <Law L>
using PiecesOf = std::remove_cvref_t<typename detail::GivenPieces<L>::Type>;

/// Whether tests hold the pieces of a law to what Law asks, at each angle and for each memory. A law that is derived
/// from a proven one has pieces of its own, and is not.
template <typename L>
inline constexpr bool is_proven = false;

/// Whether a law may go on from the state of the proxy that another law had inside the wall. Proven laws go on from
/// each other. An own law goes on from its own kind only: nobody knows what it does with the state of another one. A
/// law that is several kinds in one class says so itself: bool goes_on_from(const Own& before) const noexcept.
template <typename L, typename Before>
constexpr bool goes_on_from(const L& law, const Before& before) noexcept {
  if constexpr (is_proven<L> && is_proven<Before>)
    return true;
  else if constexpr (!std::is_same_v<L, Before>)
    return false;
  else if constexpr (requires { &L::goes_on_from; }) {
    static_assert(
        requires {
          { law.goes_on_from(before) } noexcept -> std::same_as<bool>;
        }, "the law needs, in this form: bool goes_on_from(const Own& before) const noexcept");
    return law.goes_on_from(before);
  } else
    return true;
}

/// The pieces of an untouched membrane for cos_beta. Without it: for an obliquity of the law's own, or along the
/// normal.
template <Law L, typename... Angle>
constexpr decltype(auto) untouched_pieces(const L& law, Angle... cos_beta) noexcept {
  if constexpr (requires { law.pieces(cos_beta...); })
    return law.pieces(cos_beta...);
  else if constexpr (sizeof...(Angle) == 0)
    return untouched_pieces(law, typename L::Scalar(1));
  else
    return law.pieces(cos_beta..., typename L::Memory{});
}
/// A law whose pieces depend on the obliquity of the needle at entry, K06 (17).
template <typename L>
concept ObliqueLaw = Law<L> && (requires(const L law, typename L::Scalar cos_beta) {
                       { law.pieces(cos_beta) } noexcept -> std::same_as<PiecesOf<L>>;
                     } || requires(const L law, typename L::Scalar cos_beta, const typename L::Memory& memory) {
                       { law.pieces(cos_beta, memory) } noexcept -> std::same_as<PiecesOf<L>>;
                     });

/// A law whose memory also changes with time, for example a hole that closes.
///
/// advance(memory, depth, dt) is called in each step, also while the needle is outside. depth: m, along the needle; 0
/// or less while the tip is not in the wall, or is barred. dt: time since the step before, s; 0 when a loop takes
/// another scene.
template <typename L>
concept FeelsTime = requires(const L law, typename L::Memory& memory, typename L::Scalar depth, typename L::Scalar dt) {
  { law.advance(memory, depth, dt) } noexcept -> std::same_as<bool>;
};

/// A law that remembers how the needle changed the membrane, for example the deepest point of a cut.
///
/// Memory{} is an untouched membrane. The proxy keeps the memory until it is reset, also while the needle is outside.
/// ServoStep::reset(), which clears a fault, resets the memory as well.
///
/// A membrane has one memory. The memory does not store where the needle entered, nor at which angle. A needle that
/// enters beside an old hole therefore finds the hole.
template <typename L>
concept LawWithMemory =
    Law<L> && requires(const L law, typename L::Memory& memory, typename L::Scalar cos_beta, typename L::Scalar depth) {
      requires std::is_trivially_copyable_v<typename L::Memory>;
      /// The proxy has reached this depth (m, along the needle; greater than 0). Returns true if the pieces change.
      requires FeelsTime<L> || requires {
        { law.advance(memory, depth) } noexcept -> std::same_as<bool>;
      };
      { law.pieces(cos_beta, std::as_const(memory)) } noexcept -> std::same_as<PiecesOf<L>>;
    };

/// The pieces for cos_beta. Without it, on a line: a law with an obliquity of its own has pieces(memory), any other law
/// is crossed along the normal.
template <LawWithMemory L, typename... Angle>
constexpr auto pieces_for(const L& law, const typename L::Memory& memory, Angle... cos_beta) noexcept {
  if constexpr (requires { law.pieces(cos_beta..., memory); })
    return law.pieces(cos_beta..., memory);
  else
    return law.pieces(typename L::Scalar(1), memory);
}

/// Tells a law with memory where the proxy is: depth and dt as for FeelsTime. Returns true if the pieces change.
template <LawWithMemory L>
constexpr bool advance_memory(const L& law, typename L::Memory& memory, typename L::Scalar depth,
                              [[maybe_unused]] typename L::Scalar dt) noexcept {
  if constexpr (FeelsTime<L>)
    return law.advance(memory, depth, dt);
  else
    return depth > 0 && law.advance(memory, depth);
}
/// The time step of a coupling, s, for a law that feels it.
template <LawWithMemory L, typename C>
constexpr typename L::Scalar time_step([[maybe_unused]] const C& coupling) noexcept {
  if constexpr (FeelsTime<L>)
    return coupling.period();
  else
    return typename L::Scalar(0);
}

/// Pieces that find a depth sooner if they know where the proxy is.
template <typename Pieces>
concept LooksAhead = requires(Pieces pieces, typename Pieces::Scalar q) { pieces.look_at(q); };

/// A law with memory that also hears when the tip has left the wall in front. Returns true if the pieces change.
template <typename L>
concept HearsLeaving = LawWithMemory<L> && requires(const L law, typename L::Memory& memory) {
  { law.leave(memory) } noexcept -> std::same_as<bool>;
};

/// A law with memory that can bring its pieces up to date faster than pieces(). The memory has changed since
/// pieces(), the angle has not.
template <typename L>
concept RefreshesPieces =
    LawWithMemory<L> && requires(const L law, const typename L::Memory& memory, PiecesOf<L>& pieces) {
      { law.refresh(pieces, memory) } noexcept;
    };

/// A law for lanes. Some lanes may remember. It keeps the memory and the pieces of each lane itself: a lane that is
/// in `lanes` has reached this depth, or has left the wall in front.
template <typename L>
concept LanesThatRemember = Lanes<typename L::Scalar> && requires(const L law, const typename L::Scalar& depth,
                                                                  const Mask<typename L::Scalar>& lanes) {
  { law.remembers() } noexcept -> std::same_as<bool>;  // false: no lane does
  { law.advance(depth, lanes) } noexcept;
  { law.leave(lanes) } noexcept;
};

/// False for a law that has Memory, advance(), leave() or refresh(), but not as the concepts above ask for it. Such a
/// law would run without it.
template <typename L>
constexpr bool memory_is_whole =
    LanesThatRemember<L> ||
    ((LawWithMemory<L> || !(
                              requires { typename L::Memory; } || requires { &L::advance; })) &&
     (HearsLeaving<L> || !requires { &L::leave; }) && (RefreshesPieces<L> || !requires { &L::refresh; }));

/// Whether the Memory of a law, if it has one, is plain numbers.
template <typename L>
concept PlainMemory = !requires { typename L::Memory; } ||
                      (std::is_trivially_copyable_v<typename L::Memory> &&
                       std::default_initializable<typename L::Memory> && std::copyable<typename L::Memory>);

/// Stops the compiler at a law whose memory it could not keep, with the likely causes. Otherwise true.
template <typename L>
constexpr bool check_memory() noexcept {
  static_assert(PlainMemory<L>,
                "the Memory of the law must be plain numbers, which Memory{} sets and '=' copies: without a reference, "
                "a const member, a std::string, a std::vector, and without a constructor that needs arguments, a copy "
                "constructor, an assignment or a destructor of its own");
  if constexpr (requires { typename L::Memory; })
    static_assert(
        sizeof(typename L::Memory) <= 65536,
        "the Memory of the law must have at most 64 KiB: copies of it lie on the stack of a thread, which may "
        "have only 512 KiB");
  static_assert(!PlainMemory<L> || memory_is_whole<L>,
                "a part of the law's memory is missing or has another form: struct Memory; "
                "bool advance(Memory&, Scalar depth) const noexcept, or (Memory&, Scalar depth, Scalar dt); "
                "pieces(Scalar cos_beta, const Memory&) const noexcept, of the same type as pieces(); and, where the "
                "law has them, bool leave(Memory&) const noexcept and refresh(its pieces&, const Memory&) const "
                "noexcept. Look for a const or noexcept that is missing, a result that is not bool, a private member");
  return true;
}

/// Stops the compiler at a class that is no law for a scene, with the likely causes. Otherwise true.
template <typename L>
constexpr bool check_is_law() noexcept {
  static_assert(
      ObliqueLaw<L>,
      "the class is no law for a scene. It needs, in public: using Scalar = double (or float); and "
      "pieces(Scalar cos_beta) const noexcept or pieces(Scalar cos_beta, const Memory&) const noexcept, with "
      "a PiecewiseBand or ManyPieces of Scalar as result. Look for a missing const, noexcept or argument "
      "cos_beta, and for a law_of that returns a pointer or an optional. See Law in punctura/model/law.hpp and "
      "docs/core.md");
  return true;
}

struct NoMemory {};
template <typename L>
struct MemoryOf {
  using type = NoMemory;
};
template <LawWithMemory L>
struct MemoryOf<L> {
  using type = typename L::Memory;
};

/// Lists the parameters of a law: its untouched pieces, and what the law itself adds in describe(), such as the time
/// constant of its memory.
void describe_law(const auto& law, const auto& pieces, auto& parameters) {
  pieces.describe(parameters);
  if constexpr (requires { law.describe(parameters); }) law.describe(parameters);
}

}  // namespace punctura
