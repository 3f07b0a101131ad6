// The membrane of K06 section 2.
#pragma once

namespace punctura {

/// A membrane as K06 describes it: a stack of springs that grip the needle with dry friction.
template <typename Scalar>
struct BasicMembrane {
  Scalar stiffness;       ///< kappa, N/m
  Scalar precompression;  ///< c, N
  Scalar friction;        ///< mu, -
  Scalar thickness;       ///< H, m; 0 is the thin law
};

using Membrane = BasicMembrane<double>;
using MembraneF = BasicMembrane<float>;

}  // namespace punctura
