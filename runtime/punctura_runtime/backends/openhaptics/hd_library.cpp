#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"

#include <map>
#include <mutex>

#include "punctura_runtime/os/os.hpp"

namespace punctura::hd {

namespace {

std::vector<std::string> folders() {
  std::vector<std::string> all{""};  // the system's own search
#if defined(_WIN32)
  for (const char* base : {"3DTOUCH_BASE", "OH_SDK_BASE"})
    if (const auto folder = environment(base); !folder.empty())
      for (const char* inner : {"/", "/bin/", "/lib/x64/Release/", "/lib/x64/ReleaseAcademicEdition/"})
        all.push_back(folder + inner);
#else
  if (const auto folder = environment("GTDD_HOME"); !folder.empty())
    for (const char* inner : {"/", "/lib/"}) all.push_back(folder + inner);
  for (const char* folder : {"/usr/lib/", "/usr/lib64/", "/usr/local/lib/", "/opt/OpenHaptics/Developer/3.4-0/",
                             "/opt/OpenHaptics/Developer/3.4-0/lib/", "/opt/geomagic_touch_device_driver/",
                             "/opt/geomagic_touch_device_driver/lib/"})
    all.push_back(folder);
#endif
  return all;
}

#if defined(_WIN32)
const std::vector<std::string> names{"HD.dll"};
#elif defined(__APPLE__)
const std::vector<std::string> names{"libHD.dylib"};
#else
const std::vector<std::string> names{"libHD.so", "libHD.so.3.4", "libHD.so.3.0"};
#endif

/// Version 3.4 for Linux uses functions of this library but does not name it as a dependency.
void load_hidden_dependency() {
#if !defined(_WIN32) && !defined(__APPLE__)
  std::string error;
  for (const auto& folder : folders())
    if (os::load_library((folder + "libPhantomIOLib42.so").c_str(), error)) return;
#endif
}

std::vector<Symbol> symbols(Interface& hd) {
  return {{"hdInitDevice", hd.init_device},
          {"hdDisableDevice", hd.disable_device},
          {"hdMakeCurrentDevice", hd.make_current_device},
          {"hdBeginFrame", hd.begin_frame},
          {"hdEndFrame", hd.end_frame},
          {"hdGetError", hd.get_error},
          {"hdEnable", hd.enable},
          {"hdDisable", hd.disable},
          {"hdGetIntegerv", hd.get_integers},
          {"hdGetDoublev", hd.get_doubles},
          {"hdSetDoublev", hd.set_doubles},
          {"hdGetString", hd.get_string},
          {"hdCheckCalibration", hd.check_calibration},
          {"hdCheckCalibrationStyle", hd.check_calibration_style},
          {"hdUpdateCalibration", hd.update_calibration},
          {"hdStartScheduler", hd.start_scheduler},
          {"hdStopScheduler", hd.stop_scheduler},
          {"hdSetSchedulerRate", hd.set_scheduler_rate},
          {"hdScheduleAsynchronous", hd.schedule},
          {"hdUnschedule", hd.unschedule}};
}

}  // namespace

std::vector<std::string> usual_places() {
  std::vector<std::string> all;
  for (const auto& folder : folders())
    for (const auto& name : names) all.push_back(folder + name);
  return all;
}

Loaded load(const std::string& named) {
  static std::mutex one_at_a_time;
  static auto& libraries = *new std::map<std::string, Interface>;  // by path; outlives every device
  const std::lock_guard lock(one_at_a_time);

  Loaded loaded;
  if (sizeof(void*) != 8) {
    loaded.detail = "OpenHaptics is supported on 64-bit systems only.";
    return loaded;
  }
  static const bool once = (load_hidden_dependency(), true);
  static_cast<void>(once);
  Interface hd{};
  static_cast<LoadedLibrary&>(loaded) = load_makers_library(
      {"The HD library", "PUNCTURA_HD_LIBRARY", usual_places(), "", "Install OpenHaptics and the device's driver",
       "Install OpenHaptics 3.4 or later for 64-bit systems"},
      named, symbols(hd));
  if (loaded.state == BackendStatus::State::available)
    loaded.functions = &libraries.try_emplace(loaded.path, hd).first->second;
  return loaded;
}

}  // namespace punctura::hd
