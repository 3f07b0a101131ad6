#include "punctura_runtime/backends/openhaptics/hd_errors.hpp"

#include <cstdio>

namespace punctura::hd {

namespace {

struct Words {
  std::uint32_t code;
  const char *name, *meaning;
};

constexpr Words known[] = {
    {0x100, "INVALID_ENUM", "the library does not know what was asked of it: its version is not one that we know"},
    {0x101, "INVALID_VALUE", "the library does not accept a value"},
    {0x102, "INVALID_OPERATION", "the library does not allow this now"},
    {0x103, "INVALID_INPUT_TYPE", "the library keeps this quantity in another type"},
    {bad_handle, "BAD_HANDLE", "the device is not open, or has gone: check its cable, power and driver"},
    {warm_motors, "WARM_MOTORS", "the motors are warm: the device lowers its own force; let them cool"},
    {0x201, "EXCEEDED_MAX_FORCE", "more force than the device can give: it was cut by the device"},
    {0x202, "EXCEEDED_MAX_FORCE_IMPULSE", "the force rose faster than the device allows: it was cut by the device"},
    {exceeded_max_velocity, "EXCEEDED_MAX_VELOCITY",
     "the stylus moved faster than the device allows: force was cut by the device"},
    {0x204, "FORCE_ERROR", "the device did not accept a force"},
    {device_fault, "DEVICE_FAULT", "the device reports a fault: check its power and cable, then open it again"},
    {device_already_initiated, "DEVICE_ALREADY_INITIATED",
     "the device is already open: end the other program that has it, the maker's diagnosis included, "
     "or this one if an earlier attempt in it did not close the device"},
    {0x302, "COMM_ERROR", "the link to the device broke: check its cable and power, then open it again"},
    {0x303, "COMM_CONFIG_ERROR",
     "the link to the device is not set up: run the maker's setup tool, "
     "and on Linux check that you may use the serial port"},
    {0x304, "TIMER_ERROR", "the library's clock does not keep up: close programs that keep the processor busy"},
    {0x400, "ILLEGAL_BEGIN", "a frame was begun where the library allows none"},
    {0x401, "ILLEGAL_END", "a frame was ended that had not been begun"},
    {0x402, "FRAME_ERROR", "a value was set outside a frame"},
    {0x500, "INVALID_PRIORITY", "the scheduler refuses the priority"},
    {0x501, "SCHEDULER_FULL", "the scheduler takes no more work"},
    {invalid_license, "INVALID_LICENSE",
     "the maker's licence is missing or has run out: "
     "install the developer's licence of OpenHaptics, or ask the maker for one"},
};

}  // namespace

std::string describe(const ErrorInfo& error) {
  char number[64];
  std::snprintf(number, sizeof number, " (0x%03x, internal %d)", error.code, error.internal);
  for (const Words& words : known)
    if (words.code == error.code) return words.name + std::string(number) + ": " + words.meaning;
  return "error" + std::string(number) + ": not one that we know";
}

std::string how_to_calibrate(std::uint32_t styles) {
  if (styles & inkwell) return "put the stylus into the inkwell, leave it there, and open the device again";
  if (styles & encoder_reset)
    return "hold the arm in the position that the maker calls the reset position, its links at right angles, "
           "and open the device again";
  return "move the stylus once through the whole workspace, or run the maker's calibration tool, "
         "and open the device again";
}

}  // namespace punctura::hd
