// The membrane of K06 section 2.
#pragma once

#include "punctura/model/field.hpp"

namespace punctura {

/// A membrane: a stack of springs that grip the needle with dry friction. K06 section 2
template <typename Scalar>
struct BasicMembrane {
  Scalar stiffness = Scalar(not_given);       ///< kappa, N/m
  Scalar precompression = Scalar(not_given);  ///< c, N
  Scalar friction = Scalar(not_given);        ///< mu, -
  Scalar thickness = Scalar(not_given);       ///< H, m; 0 gives the thin law
};

using Membrane = BasicMembrane<double>;
using MembraneF = BasicMembrane<float>;

}  // namespace punctura
