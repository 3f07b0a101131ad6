// A scene in which membranes have different laws.
#pragma once

#include <algorithm>
#include <tuple>
#include <utility>
#include <variant>

#include "punctura/model/law.hpp"

namespace punctura {

/// One of several laws, with a common type. `room` is the number of pieces of the largest law.
///
/// The solvers use only its pieces. They are computed when a needle enters and when advance() of a law with memory
/// returns true. The pieces of each law are a PiecewiseBand.
template <ObliqueLaw... Laws>
class MixedLaw {
 public:
  using Scalar = typename std::tuple_element_t<0, std::tuple<Laws...>>::Scalar;
  static constexpr std::size_t room = std::max({PiecesOf<Laws>::size...});
  using Pieces = PiecewiseBand<Scalar, room>;
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
      state.memory(*std::get_if<i>(&self));
    }
  };

  template <ObliqueLaw L>
    requires(std::same_as<L, Laws> || ...)
  MixedLaw(const L& law) noexcept : law_(law), pieces_(law.pieces().template with_room<room>()) {}

  const Pieces& pieces() const noexcept { return pieces_; }
  Pieces pieces(Scalar cos_beta) const noexcept { return pieces(cos_beta, Memory{}); }

  Pieces pieces(Scalar cos_beta, const Memory& memory) const noexcept { return compute_pieces(memory, cos_beta); }
  Pieces pieces(const Memory& memory) const noexcept { return compute_pieces(memory); }

  bool advance(Memory& memory, Scalar depth) const noexcept {
    bool changed = false;
    visit([&]<std::size_t i>(const auto& law) {
      if constexpr (LawWithMemory<std::tuple_element_t<i, std::tuple<Laws...>>>) {
        if (memory.index() != i) memory.template emplace<i>();
        changed = law.advance(*std::get_if<i>(&memory), depth);
      }
    });
    return changed;
  }

 private:
  /// The pieces of the law in use for cos_beta. Without cos_beta: for the obliquity of the law's constructor.
  template <typename... Angle>
  Pieces compute_pieces(const Memory& memory, Angle... cos_beta) const noexcept {
    Pieces all;
    visit([&]<std::size_t i>(const auto& law) {
      if constexpr (LawWithMemory<std::tuple_element_t<i, std::tuple<Laws...>>>) {
        using Own = std::variant_alternative_t<i, typename Memory::Each>;
        const auto* own = std::get_if<i>(&memory);
        all = law.pieces(cos_beta..., own ? *own : Own{}).template with_room<room>();
      } else {
        all = law.pieces(cos_beta...).template with_room<room>();
      }
    });
    return all;
  }

  /// Calls visitor<i>(law) for the law in use. i is its index in Laws.
  template <typename Visitor>
  void visit(Visitor&& visitor) const noexcept {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      ((law_.index() == i ? visitor.template operator()<i>(*std::get_if<i>(&law_)) : void()), ...);
    }(std::index_sequence_for<Laws...>());
  }

  std::variant<Laws...> law_;
  Pieces pieces_;
};

}  // namespace punctura
