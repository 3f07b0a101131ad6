// A scene in which membranes have different laws.
#pragma once

#include <concepts>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "punctura/model/law_flaw.hpp"

namespace punctura {

/// The pieces of one of several laws: what the solvers read of them.
template <typename... Each>
class MixedPieces {
 public:
  using Scalar = typename std::tuple_element_t<0, std::tuple<Each...>>::Scalar;

  MixedPieces() = default;
  template <std::size_t i, typename Pieces>
  constexpr MixedPieces(std::in_place_index_t<i> which, const Pieces& pieces) noexcept : of_(which, pieces) {}

  constexpr std::size_t index(const Scalar& q) const noexcept {
    return read([&](const auto& one) { return one.index(q); });
  }
  constexpr Band<Scalar> band(const Scalar& q) const noexcept {
    return read([&](const auto& one) { return one.band(q); });
  }
  constexpr Band<Scalar> band(const Scalar& q, std::size_t i) const noexcept {
    return read([&](const auto& one) { return one.band(q, i); });
  }
  constexpr BandPiece<Scalar> piece(std::size_t i) const noexcept {
    return read([&](const auto& one) -> BandPiece<Scalar> { return one.piece(i); });
  }
  constexpr Scalar end(std::size_t i) const noexcept {
    return read([&](const auto& one) -> Scalar { return one.end(i); });
  }
  constexpr std::size_t last() const noexcept {
    return read([](const auto& one) { return one.last(); });
  }
  constexpr void look_at(const Scalar& q) noexcept {
    std::visit(
        [&](auto& one) noexcept {
          if constexpr (LooksAhead<std::remove_cvref_t<decltype(one)>>) one.look_at(q);
        },
        of_);
  }
  void describe(auto& parameters) const {
    read([&](const auto& one) { one.describe(parameters); });
  }
  /// The pieces of law i, which must be in use.
  template <std::size_t i>
  constexpr auto& of() noexcept {
    return *std::get_if<i>(&of_);
  }
  template <std::size_t i>
  constexpr const auto& of() const noexcept {
    return *std::get_if<i>(&of_);
  }

 private:
  template <typename Visitor>
  constexpr auto read(Visitor&& visitor) const noexcept {
    return std::visit(visitor, of_);
  }

  std::variant<Each...> of_;
};

/// One of several laws, with a common type. It has their memory: what a law hears and remembers alone, it hears and
/// remembers here.
///
/// The pieces are changed in place (refresh()) if each law with memory can do so.
template <ObliqueLaw... Laws>
class MixedLaw {
  static_assert((check_memory<Laws>() && ...));

 public:
  using Scalar = typename std::tuple_element_t<0, std::tuple<Laws...>>::Scalar;
  using Pieces = MixedPieces<PiecesOf<Laws>...>;
  /// The memory of the law in use, from its first advance() on. Before that, the law has an untouched Memory{}.
  struct Memory : std::variant<typename MemoryOf<Laws>::type...> {
    using Each = std::variant<typename MemoryOf<Laws>::type...>;
    using Each::Each;

    static void archive(auto& self, auto& state) {
      std::size_t which = self.index();
      state.index(which, sizeof...(Laws));
      [&]<std::size_t... i>(std::index_sequence<i...>) {
        ((which == i ? archive_as<i>(self, state) : void()), ...);
      }(std::index_sequence_for<Laws...>());
    }

   private:
    template <std::size_t i>
    static void archive_as(auto& self, auto& state) {
      if constexpr (std::remove_reference_t<decltype(state)>::reading)
        if (self.index() != i) self.template emplace<i>();
      state.fields(*std::get_if<i>(&self));
    }
  };

  template <ObliqueLaw L>
    requires(std::same_as<L, Laws> || ...)
  constexpr MixedLaw(const L& law) noexcept : law_(law) {
    visit([&]<std::size_t i>(const auto& one) { pieces_ = Pieces(std::in_place_index<i>, untouched_pieces(one)); });
  }

  constexpr const Pieces& pieces() const noexcept { return pieces_; }
  constexpr Pieces pieces(Scalar cos_beta) const noexcept { return pieces(cos_beta, Memory{}); }

  constexpr Pieces pieces(Scalar cos_beta, const Memory& memory) const noexcept {
    return compute_pieces(memory, cos_beta);
  }
  constexpr Pieces pieces(const Memory& memory) const noexcept { return compute_pieces(memory); }

  constexpr bool advance(Memory& memory, Scalar depth) const noexcept
    requires(!(FeelsTime<Laws> || ...))
  {
    return advance_any(memory, depth, Scalar(0));
  }
  constexpr bool advance(Memory& memory, Scalar depth, Scalar dt) const noexcept
    requires(FeelsTime<Laws> || ...)
  {
    return advance_any(memory, depth, dt);
  }
  constexpr bool leave(Memory& memory) const noexcept
    requires(HearsLeaving<Laws> || ...)
  {
    bool changed = false;
    visit([&]<std::size_t i>(const auto& law) {
      if constexpr (HearsLeaving<Each<i>>) changed = law.leave(own<i>(memory));
    });
    return changed;
  }
  constexpr void refresh(Pieces& pieces, const Memory& memory) const noexcept
    requires((RefreshesPieces<Laws> || !LawWithMemory<Laws>) && ...)
  {
    visit([&]<std::size_t i>(const auto& law) {
      if constexpr (RefreshesPieces<Each<i>>)
        if (const auto* own = std::get_if<i>(&memory)) law.refresh(pieces.template of<i>(), *own);
    });
  }

  /// Not for a law that is derived from this one: its pieces may be others.
  static constexpr bool has_flaw(const std::same_as<MixedLaw> auto& mixed, const Pieces& pieces) noexcept {
    bool flawed = false;
    mixed.visit([&]<std::size_t i>(const auto& law) {
      if constexpr (MayHaveFlaws<Each<i>>) flawed = punctura::has_flaw(law, pieces.template of<i>());
    });
    return flawed;
  }

  /// Whether the law in use goes on from the one that was in use before.
  constexpr bool goes_on_from(const MixedLaw& before) const noexcept {
    bool goes_on = false;
    visit([&]<std::size_t>(const auto& law) {
      before.visit([&]<std::size_t>(const auto& other) { goes_on = punctura::goes_on_from(law, other); });
    });
    return goes_on;
  }

  void describe(auto& parameters) const {
    parameters.index(law_.index(), 0);
    visit([&]<std::size_t>(const auto& law) {
      if constexpr (requires { law.describe(parameters); }) law.describe(parameters);
    });
  }

  /// Calls visitor<i>(law) for the law in use. i is its index in Laws.
  template <typename Visitor>
  constexpr void visit(Visitor&& visitor) const noexcept {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      ((law_.index() == i ? visitor.template operator()<i>(*std::get_if<i>(&law_)) : void()), ...);
    }(std::index_sequence_for<Laws...>());
  }

 private:
  template <std::size_t i>
  using Each = std::tuple_element_t<i, std::tuple<Laws...>>;

  constexpr bool advance_any(Memory& memory, Scalar depth, Scalar dt) const noexcept {
    bool changed = false;
    visit([&]<std::size_t i>(const auto& law) {
      if constexpr (LawWithMemory<Each<i>>) changed = advance_memory(law, own<i>(memory), depth, dt);
    });
    return changed;
  }
  /// The memory of law i, which is in use.
  template <std::size_t i>
  static constexpr auto& own(Memory& memory) noexcept {
    if (memory.index() != i) memory.template emplace<i>();
    return *std::get_if<i>(&memory);
  }
  /// The pieces of the law in use for cos_beta. Without cos_beta: for the obliquity of the law's constructor.
  template <typename... Angle>
  constexpr Pieces compute_pieces(const Memory& memory, Angle... cos_beta) const noexcept {
    Pieces all;
    visit([&]<std::size_t i>(const auto& law) {
      if constexpr (LawWithMemory<Each<i>>) {
        const auto* own = std::get_if<i>(&memory);
        using Own = std::variant_alternative_t<i, typename Memory::Each>;
        all = Pieces(std::in_place_index<i>, pieces_for(law, own ? *own : Own{}, cos_beta...));
      } else {
        all = Pieces(std::in_place_index<i>, untouched_pieces(law, cos_beta...));
      }
    });
    return all;
  }

  std::variant<Laws...> law_;
  Pieces pieces_;
};
template <ObliqueLaw... Laws>
inline constexpr bool is_proven<MixedLaw<Laws...>> = !(MayHaveFlaws<Laws> || ...);

}  // namespace punctura
