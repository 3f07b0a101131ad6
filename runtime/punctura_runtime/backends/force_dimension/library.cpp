#include "punctura_runtime/backends/force_dimension/library.hpp"

namespace punctura::force_dimension {

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
