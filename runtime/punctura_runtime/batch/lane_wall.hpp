// The wall of one trial in the lanes of a block: the law of core for one number, and what it remembers.
#pragma once

#include <memory>

#include "punctura/model/thick_law.hpp"
#include "punctura/scene/model.hpp"
#include "punctura_runtime/batch/line_tables.hpp"
#include "punctura_runtime/batch/scene_summary.hpp"

namespace punctura::batch {

/// A membrane of a trial. Its table holds pointers into it, so it must stay where it is.
class LaneWall {
 public:
  LaneWall(const Needle& needle, const PlacedMembrane& placed);

  BandTable table() const noexcept { return tissue_ ? table_of(tissue_->pieces) : table_of(pieces_); }
  /// Computes the pieces for a needle that enters with n.b = cos_beta. Returns whether they change.
  bool lay_out(double cos_beta) noexcept;

  /// Whether it ever changes by the way of the needle. advance(), leave(): see BasicTissueLaw.
  bool remembers() const noexcept { return tissue_ && tissue_->law.remembers(); }
  void advance(double depth) noexcept;
  void leave() noexcept;
  /// The fronts of BasicHole, m; infinite if it does not remember.
  double cut() const noexcept { return remembers() ? tissue_->hole.cut : infinity; }
  double made() const noexcept { return remembers() ? tissue_->hole.made : infinity; }

  /// See BasicRunSummary. axis: of the sample.
  Crossing crossing(const Vector3d& b, const Vector3d& axis) const noexcept;
  double through(const Vector3d& axis) const noexcept;

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// A wall beyond K06.
  struct Tissue {
    SceneLaw<double> law;
    SceneLaw<double>::Pieces pieces;
    SceneLaw<double>::Memory hole{};
  };

  Needle needle_;
  PlacedMembrane placed_;
  double cos_beta_ = 1;  // of the pieces
  ThickLaw law_;
  ThickLaw::Pieces pieces_;
  std::unique_ptr<Tissue> tissue_;
};

}  // namespace punctura::batch
