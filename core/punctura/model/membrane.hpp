// The membrane of K06 section 2.
#pragma once

namespace punctura {

/// A membrane: a stack of springs that grip the needle with dry friction. K06 section 2
template <typename Scalar>
struct BasicMembrane {
  Scalar stiffness;       ///< kappa, N/m
  Scalar precompression;  ///< c, N
  Scalar friction;        ///< mu, -
  Scalar thickness;       ///< H, m; 0 gives the thin law
};

using Membrane = BasicMembrane<double>;
using MembraneF = BasicMembrane<float>;

}  // namespace punctura
