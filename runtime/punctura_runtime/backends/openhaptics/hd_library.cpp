#include "punctura_runtime/backends/openhaptics/hd_library.hpp"

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>

#include "punctura_runtime/os/os.hpp"

namespace punctura::hd {

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

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

/// Version 3.4 for Linux uses functions of this one without naming it.
void load_what_the_library_forgets() {
#if !defined(_WIN32) && !defined(__APPLE__)
  static const os::Library io = [] {  // for the rest of the process
    std::vector<std::string> places;
    for (const auto& folder : folders()) places.push_back(folder + "libPhantomIOLib42.so");
    return os::Library::open(places);
  }();
#endif
}

template <typename Function>
void resolve(const os::Library& library, const char* name, Function& slot, std::string& missing) {
  slot = reinterpret_cast<Function>(library.symbol(name));
  if (!slot) missing += (missing.empty() ? "" : ", ") + std::string(name);
}

/// The names of those that are missing.
std::string resolve_all(const os::Library& library, Interface& to) {
  std::string missing;
  resolve(library, "hdInitDevice", to.init_device, missing);
  resolve(library, "hdDisableDevice", to.disable_device, missing);
  resolve(library, "hdMakeCurrentDevice", to.make_current_device, missing);
  resolve(library, "hdBeginFrame", to.begin_frame, missing);
  resolve(library, "hdEndFrame", to.end_frame, missing);
  resolve(library, "hdGetError", to.get_error, missing);
  resolve(library, "hdEnable", to.enable, missing);
  resolve(library, "hdDisable", to.disable, missing);
  resolve(library, "hdGetIntegerv", to.get_integers, missing);
  resolve(library, "hdGetDoublev", to.get_doubles, missing);
  resolve(library, "hdSetDoublev", to.set_doubles, missing);
  resolve(library, "hdGetString", to.get_string, missing);
  resolve(library, "hdCheckCalibration", to.check_calibration, missing);
  resolve(library, "hdCheckCalibrationStyle", to.check_calibration_style, missing);
  resolve(library, "hdUpdateCalibration", to.update_calibration, missing);
  resolve(library, "hdStartScheduler", to.start_scheduler, missing);
  resolve(library, "hdStopScheduler", to.stop_scheduler, missing);
  resolve(library, "hdSetSchedulerRate", to.set_scheduler_rate, missing);
  resolve(library, "hdScheduleAsynchronous", to.schedule, missing);
  resolve(library, "hdUnschedule", to.unschedule, missing);
  return missing;
}

struct Kept {
  std::string path;
  os::Library library;
  Interface functions{};
};

Loaded opened(os::Library library) {
  static auto* kept = new std::vector<std::unique_ptr<Kept>>;  // never unloaded
  for (const auto& one : *kept)
    if (one->path == library.path()) return {&one->functions, BackendStatus::State::available, one->path};

  auto one = std::make_unique<Kept>(Kept{library.path(), std::move(library), {}});
  if (const auto missing = resolve_all(one->library, one->functions); !missing.empty())
    return {nullptr, BackendStatus::State::symbol_missing,
            one->path + " lacks " + missing + ". Install OpenHaptics 3.4 or later for 64-bit systems."};
  kept->push_back(std::move(one));
  return {&kept->back()->functions, BackendStatus::State::available, kept->back()->path};
}

/// Whether the file is there and yet does not load: then the reason is worth more than the list of places.
bool is_there(const std::string& place, const std::string& error) {
  std::error_code ignored;
  if (place.find_first_of("/\\") != std::string::npos) return std::filesystem::exists(place, ignored);
  return error.find("cannot open shared object") != std::string::npos && error.rfind(place + ":", 0) != 0;
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
  const std::lock_guard lock(one_at_a_time);
  if (sizeof(void*) != 8)
    return {nullptr, BackendStatus::State::library_not_found, "OpenHaptics is supported on 64-bit systems only."};

  const std::string wish = named.empty() ? environment("PUNCTURA_HD_LIBRARY") : named;
  load_what_the_library_forgets();
  std::string looked, broken;
  for (const auto& place : wish.empty() ? usual_places() : std::vector<std::string>{wish}) {
    if (auto library = os::Library::open({place}))
      return opened(std::move(library));
    else if (is_there(place, library.error()))
      broken += " " + place + " is there but does not load: " + library.error() + ".";
    looked += (looked.empty() ? "" : ", ") + place;
  }
  return {nullptr, BackendStatus::State::library_not_found,
          "The HD library was not found: looked for " + looked + "." + broken +
              " Install OpenHaptics and the device's driver, or name the library in PUNCTURA_HD_LIBRARY."};
}

}  // namespace punctura::hd
