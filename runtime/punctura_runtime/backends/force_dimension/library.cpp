#include "punctura_runtime/backends/force_dimension/library.hpp"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>

#include "punctura_runtime/os/os.hpp"

namespace punctura::force_dimension {

namespace {

constexpr const char* override_name = "PUNCTURA_DRD_LIBRARY";

/// Takes functions out of a library, and remembers those that it lacks.
class Resolver {
 public:
  explicit Resolver(const os::Library& library) : library_(library) {}

  template <typename Function>
  void need(Function*& function, const char* name) {
    if (!want(function, name)) missing_ += (missing_.empty() ? "" : ", ") + std::string(name);
  }
  template <typename Function>
  bool want(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(library_.symbol(name));
    return function != nullptr;
  }
  const std::string& missing() const noexcept { return missing_; }

 private:
  const os::Library& library_;
  std::string missing_;
};

void resolve(Loaded& loaded, const os::Library& library) {
  Resolver from(library);
  Api& api = loaded.api;
  from.need(api.device_count, "dhdGetDeviceCount");
  from.need(api.available_count, "dhdGetAvailableCount");
  from.need(api.open, "dhdOpenID");
  from.need(api.close, "dhdClose");
  from.need(api.system_type, "dhdGetSystemType");
  from.need(api.system_name, "dhdGetSystemName");
  from.need(api.serial_number, "dhdGetSerialNumber");
  from.need(api.version, "dhdGetSDKVersion");
  from.need(api.has_wrist, "dhdHasWrist");
  from.need(api.status, "dhdGetStatus");
  from.need(api.enable_force, "dhdEnableForce");
  from.need(api.max_force, "dhdGetMaxForce");
  from.need(api.buttons, "dhdGetButtonMask");
  from.need(api.read, "dhdGetPositionAndOrientationFrame");
  from.need(api.write, "dhdSetForceAndTorqueAndGripperForce");
  from.need(api.last_error, "dhdErrorGetLast");
  from.need(api.error_text, "dhdErrorGetStr");
  from.want(api.robot_open, "drdOpenID");
  from.want(api.robot_close, "drdClose");
  from.want(api.robot_auto_init, "drdAutoInit");

  loaded.path = library.path();
  if (from.missing().empty()) {
    loaded.state = BackendStatus::State::available;
    return;
  }
  loaded.state = BackendStatus::State::symbol_missing;
  loaded.detail =
      library.path() + " lacks " + from.missing() +
      ". It is probably too old, or another library: install a newer SDK of Force Dimension's, or name the library to "
      "take with " +
      override_name + "=/path/to/library.";
}

/// What was tried, and what the system said of the files that are there and yet do not open.
std::string not_found(const std::vector<std::string>& names, const std::string& complaints, bool named) {
  const auto joined = [](const std::vector<std::string>& all) {
    std::string text;
    for (const auto& one : all) text += (text.empty() ? "" : ", ") + one;
    return text;
  };
  const std::string tried = joined(names);
  std::string text = named ? "The library named for Force Dimension's devices does not open: " + tried + "."
                           : "Force Dimension's library was not found; tried: " + tried +
                                 ", and looked for files of such names in " + joined(searched_folders()) + ".";
  if (!complaints.empty()) text += " The system says: " + complaints + ".";
  return text + (named ? " Name another one" : " Install Force Dimension's SDK and libusb-1.0, or name the library") +
         " with " + override_name + "=/path/to/library.";
}

}  // namespace

Loaded load(const std::string& path) {
  static std::mutex one_at_a_time;
  static auto& open = *new std::map<std::string, os::Library>;  // for good
  const std::lock_guard lock(one_at_a_time);

  const char* from_environment = std::getenv(override_name);
  const bool named = !path.empty() || (from_environment && *from_environment);
  const std::vector<std::string> names =
      !path.empty() ? std::vector{path} : (named ? std::vector<std::string>{from_environment} : candidates());

  Loaded loaded;
  std::string complaints;
  for (const auto& name : names) {
    auto known = open.find(name);
    if (known == open.end()) {
      os::Library library = os::Library::open({name});
      if (!library) {
        std::error_code nothing;
        if (named || std::filesystem::exists(name, nothing))
          complaints += (complaints.empty() ? "" : "; ") + library.error();
        continue;
      }
      known = open.emplace(name, std::move(library)).first;
    }
    resolve(loaded, known->second);
    return loaded;
  }
  loaded.detail = not_found(names, complaints, named);
  return loaded;
}

}  // namespace punctura::force_dimension
