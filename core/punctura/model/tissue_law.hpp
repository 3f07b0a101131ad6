// The law of a membrane of measured tissue: K06's membrane with the additions of tissue.hpp, each of which can be off.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "punctura/model/grip.hpp"
#include "punctura/model/law.hpp"
#include "punctura/model/profile_law.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/model/tissue_band.hpp"

namespace punctura {

/// What a wall remembers of one needle: one hole.
template <typename Scalar>
struct BasicHole {
  Scalar cut{};   ///< the deepest point that the tip has reached, m along the needle
  Scalar made{};  ///< the deepest point that it had reached when it last left, m

  static void archive(auto& self, auto& state) {
    state.fields(self.cut, self.made);
    state.require(self.made >= 0 && self.made <= self.cut);
  }
};

/// The law of measured tissue. docs/measured-tissue.md derives it.
///
/// With curve, tip length, tail and profile at their defaults the pieces are those of K06's thick law, bit for bit.
/// Otherwise they are those of a profile. Parameters must have passed check().
template <typename Scalar_>
class BasicTissueLaw {
 public:
  using Scalar = Scalar_;
  /// Breaks: the knots, the same behind the far face, at most four of the cutting, the end of a hole, and the knots
  /// behind the slices that the tip has passed.
  using Pieces = TissueBand<Scalar, 3 * max_knots + 6>;
  using Memory = BasicHole<Scalar>;

  /// cos_beta: n.b, for pieces() without n.b. chords: see profile_of().
  constexpr BasicTissueLaw(const BasicNeedle<Scalar>& needle, const BasicMembrane<Scalar>& membrane,
                           const BasicTissue<Scalar>& tissue, Scalar cos_beta = Scalar(1),
                           std::size_t chords = 0) noexcept
      : k06_(needle, membrane),
        has_k06_grip_(has_k06_grip(tissue)),
        remembers_(punctura::remembers(tissue)),
        H_(membrane.thickness),
        X_(punctura::tip_length(needle, tissue)),
        C_(tissue.cutting),
        set_(tissue.set),
        cos_beta_(cos_beta) {
    if (!tissue.profile.empty())
      profile_ = BasicProfile<Scalar>(tissue.profile);
    else if (!has_k06_grip_ || set_ > 0)
      profile_ = profile_of(needle, membrane, tissue, chords).profile;
    pieces_ = pieces(cos_beta);
  }

  /// The pieces of the untouched wall for a needle that enters with n.b = cos_beta > 0.
  constexpr Pieces pieces(Scalar cos_beta) const noexcept { return pieces(cos_beta, Memory{}); }
  constexpr Pieces pieces(Scalar cos_beta, const Memory& memory) const noexcept {
    Pieces all;
    if (has_k06_grip_)
      add_k06(cos_beta, all);
    else
      detail::average(profile_, H_, cos_beta, all);
    all.kept = 1 - set_;
    all.cos_beta = cos_beta;
    all.whole = X_ + H_ / cos_beta;
    all.hole = memory.made;
    if (set_ > 0 && memory.made > all.breaks[0]) open(memory.made, all);
    if (C_ > 0) add_cutting(cos_beta, all);
    all.set_fronts(memory.cut);
    // check() refuses such a set. Laws of law_of have not passed it, and this one would pull the needle in.
    if (!(set_ >= 0 && set_ <= 1)) all.pieces[1].lower.c0 = std::numeric_limits<Scalar>::quiet_NaN();
    return all;
  }
  constexpr Pieces pieces(const Memory& memory) const noexcept { return pieces(cos_beta_, memory); }
  constexpr const Pieces& pieces() const noexcept { return pieces_; }

  constexpr bool remembers() const noexcept { return remembers_; }  ///< whether a needle changes the wall
  /// The proxy has reached this depth, m along the needle.
  constexpr bool advance(Memory& memory, Scalar depth) const noexcept {
    if (!remembers_ || !(depth > memory.cut)) return false;
    memory.cut = depth;
    return C_ > 0;
  }
  /// The tip is outside, in front: from now on, its way is a hole.
  constexpr bool leave(Memory& memory) const noexcept {
    if (!(memory.made < memory.cut)) return false;
    memory.made = memory.cut;
    return set_ > 0;
  }
  /// Changes these pieces to this memory: in little time while the needle is in the wall.
  constexpr void refresh(Pieces& all, const Memory& memory) const noexcept {
    if (set_ > 0 && all.hole < memory.made)
      lay_out_again(all, memory);
    else
      all.set_cut(memory.cut);
  }

  constexpr Band<Scalar> band(Scalar q) const noexcept {
    return pieces_.band(q);
  }  ///< of the untouched wall at q (m), N
  constexpr Scalar thickness() const noexcept { return H_; }   ///< H, m
  constexpr Scalar tip_length() const noexcept { return X_; }  ///< X, m

 private:
  [[gnu::noinline, gnu::cold]] constexpr void lay_out_again(Pieces& all, const Memory& memory) const noexcept {
    all = pieces(all.cos_beta, memory);
  }
  constexpr void add_k06(const Scalar& cos_beta, Pieces& all) const noexcept {
    const auto own = k06_.pieces(cos_beta);
    for (std::size_t i = 0; i < own.breaks.size(); ++i) all.add(own.breaks[i], own.pieces[i + 1]);
  }
  /// The hole of a needle that has left: its tip had been at this depth, m. Behind it, the slices that the tip had
  /// passed lie on the shaft. They lose their part of the average over the path.
  constexpr void open(const Scalar& made, Pieces& all) const noexcept {
    if (!(made < all.whole)) return all.open_whole();
    const Scalar passed = (made - X_) * all.cos_beta;  // m, along the normal
    ManyPieces<Scalar, 2 * max_knots + 1> slices;
    if (!(passed > 0)) return all.open(made, slices, Scalar(0));
    detail::average(profile_, passed, all.cos_beta, slices);
    all.open(made, slices, set_ * passed / H_);
  }
  /// Adds C times the part of the path that lies on the tip, over H: the average of C on [0, X].
  constexpr void add_cutting(const Scalar& cos_beta, Pieces& all) const noexcept {
    using namespace lane;
    const Scalar U = H_ / cos_beta;
    for (const Scalar& at : {Scalar(0), U, X_, Scalar(X_ + U)}) all.split(at);
    for (std::size_t i = 1; i + 1 < all.count; ++i) {
      const Scalar begin = all.breaks[i - 1], middle = (begin + all.breaks[i]) / 2, x = all.pieces[i].origin - begin;
      auto& cutting = all.cutting[i];
      if (H_ > 0) {
        const Scalar enters = middle < X_ ? C_ / H_ : Scalar(0), leaves = middle > U ? C_ / H_ : Scalar(0);
        const Scalar on_tip = max(Scalar(min(begin, X_) - max(Scalar(begin - U), Scalar(0))), Scalar(0));
        cutting.c1 = middle < X_ + U ? enters - leaves : Scalar(0);
        cutting.c0 = C_ * on_tip / H_ + cutting.c1 * x;
      } else if (middle < X_) {
        cutting.c0 = C_ / cos_beta;
      }
      all.pieces[i].lower.c0 -= cutting.c0;
      all.pieces[i].lower.c1 -= cutting.c1;
    }
    all.cuts = true;
  }

  BasicThickLaw<Scalar> k06_;
  bool has_k06_grip_, remembers_;
  Scalar H_, X_, C_, set_, cos_beta_;
  BasicProfile<Scalar> profile_;
  Pieces pieces_;
};
template <typename Scalar>
inline constexpr bool is_proven<BasicTissueLaw<Scalar>> = true;
using TissueLaw = BasicTissueLaw<double>;
static_assert(ObliqueLaw<TissueLaw> && LawWithMemory<TissueLaw>);

/// Adds a problem if most_chords do not follow the grip, or if the cutting begins in front of the profile. Returns true
/// if there is none. All parameters must be inside their ranges.
inline bool check_curve(const Needle& needle, const Membrane& membrane, const Tissue& tissue, const std::string& path,
                        std::vector<Problem>& problems) {
  const std::string dot = path.empty() ? "" : path + ".";
  if (!tissue.profile.empty()) {
    if (tissue.cutting == 0 || tissue.profile[0].depth == 0) return true;
    problems.push_back({dot + "profile[0].depth", tissue.profile[0].depth,
                        "must be 0 m in a wall that the tip cuts: cutting begins at the surface"});
    return false;
  }
  if (tissue.grip != GripShape::exponential) return true;
  const auto made = profile_of(needle, membrane, tissue);
  if (made.follows && std::isfinite(made.error)) return true;  // the grip may overflow
  problems.push_back({dot + "growth", tissue.growth,
                      "is too large for this needle: " + std::to_string(most_chords) +
                          " chords miss the grip by more than " + decimal_text(most_chord_error) +
                          " of the largest force. Take a growth nearer to 0, a thicker wall, or a grip_table of your "
                          "own"});
  return false;
}

}  // namespace punctura
