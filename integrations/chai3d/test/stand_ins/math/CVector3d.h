// A stand-in for the functions of CHAI3D's vector that the effect uses, for tests without CHAI3D. No copy of its code.
#pragma once

namespace chai3d {
class cVector3d {
 public:
  cVector3d() : cVector3d(0, 0, 0) {}
  cVector3d(double x, double y, double z) { set(x, y, z); }
  double x() const { return v[0]; }
  double y() const { return v[1]; }
  double z() const { return v[2]; }
  void set(double x, double y, double z) { v[0] = x, v[1] = y, v[2] = z; }
  void zero() { set(0, 0, 0); }

 private:
  double v[3];
};
}  // namespace chai3d
