#include <algorithm>
#include <filesystem>
#include <system_error>

#include "punctura_runtime/backends/force_dimension/dhd_api.hpp"

namespace punctura::force_dimension {

namespace {

namespace fs = std::filesystem;

#if defined(__aarch64__) || defined(_M_ARM64)
[[maybe_unused]] constexpr const char *linux_machine = "aarch64", *mac_machine = "arm64";
#elif defined(__i386__)
[[maybe_unused]] constexpr const char *linux_machine = "i686", *mac_machine = "i386";
#else
[[maybe_unused]] constexpr const char *linux_machine = "x86_64", *mac_machine = "x86_64";
#endif

/// The entries of a folder whose names have this prefix, the newest version first: 3.17.5 before 3.9.0.
std::vector<fs::path> matching(const fs::path& folder, const std::string& beginning) {
  std::vector<fs::path> found;
  std::error_code nothing;
  if (folder.empty()) return found;
  for (const auto& entry : fs::directory_iterator(folder, nothing))
    if (entry.path().filename().string().rfind(beginning, 0) == 0) found.push_back(entry.path());

  const auto numbers = [](const fs::path& path) {
    std::vector<int> all{0};
    for (const char c : path.filename().string()) {
      if (c >= '0' && c <= '9' && all.back() < 100000) all.back() = all.back() * 10 + (c - '0');
      if (c == '.' || c == '-') all.push_back(0);
    }
    return all;
  };
  std::sort(found.begin(), found.end(),
            [&](const auto& a, const auto& b) { return std::pair(numbers(a), a) > std::pair(numbers(b), b); });
  return found;
}

struct Places {
  std::vector<fs::path> folders;
  std::string suffix;              ///< of a library's file name: drd + suffix + anything
  std::vector<std::string> names;  ///< endings of the names that the system looks up
};

Places places() {
  const fs::path sdk = environment("FDSDK");
  Places all;
#if defined(_WIN32)
  if (!sdk.empty()) all.folders.push_back(sdk / "bin");
  for (const char* base : {"LOCALAPPDATA", "ProgramFiles"})
    for (const auto& version : matching(fs::path(environment(base)) / "Force Dimension", "sdk-"))
      all.folders.push_back(version / "bin");
  all.suffix = "64.dll";
  all.names = {"64.dll"};
#elif defined(__APPLE__)
  if (!sdk.empty()) all.folders.push_back(sdk / "lib/release" / (std::string("mac-") + mac_machine + "-clang"));
  if (const auto home = fs::path(environment("HOME")); !home.empty()) all.folders.push_back(home / ".local/lib");
  all.folders.push_back("/usr/local/lib");
  all.suffix = ".";
  all.names = {".3.dylib", ".dylib"};
#else
  if (!sdk.empty()) all.folders.push_back(sdk / "lib/release" / (std::string("lin-") + linux_machine + "-gcc"));
  if (const auto home = fs::path(environment("HOME")); !home.empty()) all.folders.push_back(home / ".local/lib");
  all.folders.push_back("/usr/local/lib");
  all.suffix = ".so";
  all.names = {".so.3", ".so"};
#endif
  return all;
}

}  // namespace

std::vector<std::string> searched_folders() {
  std::vector<std::string> all;
  for (const auto& folder : places().folders) all.push_back(folder.string());
  return all;
}

std::vector<std::string> candidates() {
#if defined(_WIN32)
  const std::string stem;
#else
  const std::string stem = "lib";
#endif
  const Places where = places();
  std::vector<std::string> all;
  for (const char* library : {"drd", "dhd"}) {
    for (const auto& folder : where.folders)
      for (const auto& file : matching(folder, stem + library + where.suffix)) all.push_back(file.string());
    for (const auto& name : where.names) all.push_back(stem + library + name);
  }
  return all;
}

namespace {

std::vector<Symbol> symbols(Api& api) {
  return {{"dhdGetDeviceCount", api.device_count},
          {"dhdGetAvailableCount", api.available_count},
          {"dhdOpenID", api.open},
          {"dhdClose", api.close},
          {"dhdGetSystemType", api.system_type},
          {"dhdGetSystemName", api.system_name},
          {"dhdGetSerialNumber", api.serial_number},
          {"dhdGetSDKVersion", api.version},
          {"dhdHasWrist", api.has_wrist},
          {"dhdGetStatus", api.status},
          {"dhdEnableForce", api.enable_force},
          {"dhdGetMaxForce", api.max_force},
          {"dhdGetButtonMask", api.buttons},
          {"dhdGetPositionAndOrientationFrame", api.read},
          {"dhdSetForceAndTorqueAndGripperForce", api.write},
          {"dhdErrorGetLast", api.last_error},
          {"dhdErrorGetStr", api.error_text},
          {"drdOpenID", api.robot_open, Symbol::optional},
          {"drdClose", api.robot_close, Symbol::optional},
          {"drdAutoInit", api.robot_auto_init, Symbol::optional}};
}

}  // namespace

Loaded load(const std::string& named) {
  Loaded loaded;
  static_cast<LoadedLibrary&>(loaded) =
      load_makers_library({"Force Dimension's library", "PUNCTURA_DRD_LIBRARY", candidates(),
                           ", and for files of such names in " + joined(searched_folders()),
                           "Install Force Dimension's SDK and libusb-1.0", "Install a newer SDK of Force Dimension"},
                          named, symbols(loaded.api));
  return loaded;
}

}  // namespace punctura::force_dimension
