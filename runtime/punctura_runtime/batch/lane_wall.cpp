#include "punctura_runtime/batch/lane_wall.hpp"

namespace punctura::batch {

LaneWall::LaneWall(const Needle& needle, const PlacedMembrane& placed)
    : needle_(needle), placed_(placed), law_(needle, placed.membrane), pieces_(law_.pieces(1)) {
  if (is_k06(placed.tissue)) return;
  const SceneLaw<double> law(needle, placed.membrane, placed.tissue);
  tissue_ = std::make_unique<Tissue>(Tissue{law, law.pieces(1)});
}

bool LaneWall::lay_out(double cos_beta) noexcept {
  if (cos_beta == cos_beta_) return false;                  // the fronts are up to date
  if (!(cos_beta >= grazing_cosine<double>)) return false;  // it does not enter
  cos_beta_ = cos_beta;
  if (tissue_)
    tissue_->pieces = tissue_->law.pieces(cos_beta, tissue_->hole);
  else
    pieces_ = law_.pieces(cos_beta);
  return true;
}

void LaneWall::advance(double depth) noexcept {
  if (tissue_->law.advance(tissue_->hole, depth)) tissue_->law.refresh(tissue_->pieces, tissue_->hole);
}

void LaneWall::leave() noexcept {
  if (tissue_->law.leave(tissue_->hole)) tissue_->law.refresh(tissue_->pieces, tissue_->hole);
}

Crossing LaneWall::crossing(const Vector3d& b, const Vector3d& axis) const noexcept {
  if (tissue_) return crossing_along(tissue_->law, needle_, placed_, b, axis);
  return crossing_along(law_, needle_, placed_, b, axis);
}

double LaneWall::through(const Vector3d& axis) const noexcept {
  if (tissue_) return through_along(tissue_->law, needle_, placed_, axis);
  return through_along(law_, needle_, placed_, axis);
}

}  // namespace punctura::batch
