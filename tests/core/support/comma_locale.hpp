// A locale with a decimal comma for a whole program, also where the system has none installed.
#pragma once

#include <clocale>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace punctura::test {

/// While it exists, printf and strtod of the C library use a comma.
class CommaLocale {
 public:
  CommaLocale() {
#ifdef __GLIBC__
    // LC_NUMERIC as localedef compiles it: six values and their places.
    const auto folder = std::filesystem::temp_directory_path() / "punctura-comma-locale";
    std::filesystem::create_directories(folder / "comma");
    const std::uint32_t head[] = {0x20031115 ^ 1, 6, 32, 34, 35, 36, 40, 44};
    const char values[] = ",\0\0\0,\0\0\0\0\0\0\0UTF-8";
    std::ofstream file(folder / "comma/LC_NUMERIC", std::ios::binary);
    file.write(reinterpret_cast<const char*>(head), sizeof head).write(values, sizeof values);
    file.close();
    setenv("LOCPATH", folder.c_str(), 1);
    std::setlocale(LC_NUMERIC, "comma");
    std::filesystem::remove_all(folder);
#else
    std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
#endif
  }
  ~CommaLocale() { std::setlocale(LC_NUMERIC, "C"); }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  /// Whether the system has such a locale.
  static bool works() { return std::snprintf(nullptr, 0, "%g", 0.5) > 0 && std::localeconv()->decimal_point[0] == ','; }
};

}  // namespace punctura::test
