// The exports of the fake library: the maker's functions with their names and types, and functions for tests.
//
// As in the real library, a device's number is a char, and -1 is the default device. A bool is returned in the low
// byte of a register; the other bytes are undefined. Each thread has its own last error.
#include "controller.hpp"

#if defined(_WIN32)
#define EXPORTED extern "C" __declspec(dllexport)
#else
#define EXPORTED extern "C" __attribute__((visibility("default")))
#endif

using namespace punctura;
using namespace punctura::fake_drd;

namespace {

constexpr unsigned long garbage = 0x5EED5A00UL;  // under the byte that counts
unsigned long as_bool(bool value) { return garbage | (value ? 1UL : 0UL); }

/// The controller, locked during a call.
class Locked {
 public:
  Locked() : lock_(controller().mutex) {}
  Controller* operator->() const { return &controller(); }

 private:
  std::lock_guard<std::mutex> lock_;
};

int unimplemented() {
  Controller::error = 10;
  return -1;
}

/// Calls that change a protection of the user's hand. The back-end must not make them.
int safety() {
  Locked()->safety_touched = true;
  return 0;
}

}  // namespace

EXPORTED int dhdErrorGetLast() { return Controller::error; }
EXPORTED const char* dhdErrorGetStr(int error) { return error == 0 ? "no error" : "a simulated error"; }
EXPORTED const char* dhdErrorGetLastStr() { return dhdErrorGetStr(Controller::error); }
EXPORTED void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
  *major = 3, *minor = 17, *release = 5, *revision = 0;
}

EXPORTED int dhdGetDeviceCount() { return Locked()->settings.devices; }
EXPORTED int dhdGetAvailableCount() {
  const Locked c;
  return c->settings.in_use ? 0 : c->settings.devices - (c->is_open ? 1 : 0);
}
EXPORTED int dhdOpenID(char index) { return Locked()->open(index); }
EXPORTED int dhdOpen() { return Locked()->open(0); }
EXPORTED int dhdClose(char id) { return Locked()->close(id); }
EXPORTED int drdOpenID(char index) { return Locked()->open(index); }
EXPORTED int drdOpen() { return Locked()->open(0); }
EXPORTED int drdClose(char id) { return Locked()->close(id); }
EXPORTED int drdAutoInit(char id) {
  const Locked c;
  return c->wrong(id) ? -1 : c->calibrate();
}
EXPORTED unsigned long drdIsInitialized(char id) {
  const Locked c;
  int status[32] = {};
  return as_bool(!c->wrong(id) && c->status(status) == 0 && status[3] == 0);
}

EXPORTED int dhdGetSystemType(char id) {
  const Locked c;
  return c->wrong(id) ? -1 : c->settings.system_type;
}
EXPORTED const char* dhdGetSystemName(char id) {
  const Locked c;
  return c->wrong(id) ? nullptr : c->settings.system_type == 60 ? "Falcon" : c->settings.wrist ? "omega.6" : "omega.3";
}
EXPORTED int dhdGetSerialNumber(unsigned short* number, char id) {
  const Locked c;
  if (c->wrong(id)) return -1;
  *number = 12345;
  return 0;
}
EXPORTED unsigned long dhdHasWrist(char id) {
  const Locked c;
  return as_bool(!c->wrong(id) && c->settings.wrist);
}
EXPORTED unsigned long dhdIsLeftHanded(char) { return as_bool(false); }
EXPORTED double dhdGetMaxForce(char id) {
  const Locked c;
  return c->wrong(id) ? -1 : c->settings.user_max_force;
}
EXPORTED double dhdGetComFreq(char id) { return Locked()->wrong(id) ? 0.0 : 4.0; }

EXPORTED int dhdGetStatus(int* array, char id) {
  const Locked c;
  return c->wrong(id) ? -1 : c->status(array);
}
EXPORTED int dhdEnableForce(unsigned char on, char id) {
  const Locked c;
  return c->wrong(id) ? -1 : c->enable_force(on != 0);
}
EXPORTED int dhdGetButton(int index, char id) {
  const Locked c;
  return c->wrong(id) ? -1 : static_cast<int>((c->buttons >> index) & 1U);
}
EXPORTED unsigned dhdGetButtonMask(char id) {
  const Locked c;
  return c->wrong(id) ? 0 : c->buttons;
}

EXPORTED int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double (*frame)[3], char id) {
  const Locked c;
  if (c->wrong(id)) return -1;
  double position[3];
  const int result = c->read(position);
  if (result < 0) return result;
  *x = position[0], *y = position[1], *z = position[2];
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) frame[row][column] = c->settings.frame[row][column];
  return result;
}
EXPORTED int dhdGetPosition(double* x, double* y, double* z, char id) {
  double frame[3][3];
  return dhdGetPositionAndOrientationFrame(x, y, z, frame, id);
}
EXPORTED int dhdGetOrientationFrame(double (*frame)[3], char id) {
  double x, y, z;
  return dhdGetPositionAndOrientationFrame(&x, &y, &z, frame, id);
}
EXPORTED int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty, double tz,
                                                 double grip, char id) {
  const Locked c;
  if (tx != 0 || ty != 0 || tz != 0 || grip != 0) return unimplemented();
  const double force[3] = {fx, fy, fz};
  return c->wrong(id) ? -1 : c->write(force);
}
EXPORTED int dhdSetForceAndTorque(double fx, double fy, double fz, double tx, double ty, double tz, char id) {
  return dhdSetForceAndTorqueAndGripperForce(fx, fy, fz, tx, ty, tz, 0, id);
}
EXPORTED int dhdSetForce(double fx, double fy, double fz, char id) {
  return dhdSetForceAndTorqueAndGripperForce(fx, fy, fz, 0, 0, 0, 0, id);
}

EXPORTED int dhdEnableExpertMode() { return safety(); }
EXPORTED int dhdSetVelocityThreshold(unsigned, char) { return safety(); }
EXPORTED int dhdSetWatchdog(unsigned char, char) { return safety(); }
EXPORTED int dhdSetBrakes(int, char) { return safety(); }
EXPORTED int dhdSetMaxForce(double, char) { return safety(); }
EXPORTED int dhdSetGravityCompensation(int, char) { return safety(); }

EXPORTED void fake_drd_reset(const Settings* settings) { Locked()->reset(settings ? *settings : Settings{}); }
EXPORTED void fake_drd_virtual_time(int on) { Locked()->use_virtual_time(on != 0); }
EXPORTED std::int64_t fake_drd_now() { return Locked()->now(); }
EXPORTED void fake_drd_advance(std::int64_t to) { Locked()->advance(to); }
EXPORTED void fake_drd_strokes(const punctura::fake_drd::Strokes* strokes) { Locked()->begin(*strokes); }
EXPORTED void fake_drd_target(double x, double y, double z) { Locked()->move_to(Vector3d(x, y, z)); }
EXPORTED void fake_drd_buttons(unsigned mask) { Locked()->buttons = mask; }
EXPORTED void fake_drd_inject(int what, std::int64_t at) { Locked()->inject(what, at); }
EXPORTED void fake_drd_report(Report* report) { *report = Locked()->report(); }
