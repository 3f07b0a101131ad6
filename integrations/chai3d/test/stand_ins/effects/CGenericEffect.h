// A stand-in for the interface of CHAI3D's effects, for tests without CHAI3D. No copy of its code.
#pragma once

#include "math/CVector3d.h"

namespace chai3d {
class cGenericObject {};
class cGenericEffect {
 public:
  explicit cGenericEffect(cGenericObject* parent) : m_parent(parent), m_enabled(true) {}
  virtual ~cGenericEffect() {}
  virtual bool computeForce(const cVector3d&, const cVector3d&, const unsigned int&, cVector3d&) = 0;
  void setEnabled(bool enabled) { m_enabled = enabled; }
  cGenericObject* m_parent;

 protected:
  bool m_enabled;
};
}  // namespace chai3d
