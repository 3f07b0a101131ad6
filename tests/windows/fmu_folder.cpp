// An FMU starts in a folder whose name is no text of the system's code page. tools/windows.sh runs this under Wine.
//   fmu_folder FMU.dll SCENE.txt
#include <windows.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Callbacks {
  void (*logger)(void*, const char*, int, const char*, const char*, ...);
  void* others[4];
};
void log2(void*, const char*, int, const char*, const char*, ...) { std::puts("FMI 2: refused"); }
void log3(void*, int, const char*, const char* text) { std::printf("FMI 3: %s\n", text); }

using Make2 = void* (*)(const char*, int, const char*, const char*, const Callbacks*, int, int);
using Make3 = void* (*)(const char*, const char*, const char*, bool, bool, bool, bool, const std::uint32_t*,
                        std::size_t, void*, void (*)(void*, int, const char*, const char*), void*);

template <typename F>
F function(HMODULE library, const char* name) {
  return reinterpret_cast<F>(reinterpret_cast<void*>(GetProcAddress(library, name)));
}

/// "C:/a b" as "file:///C:/a%20b"
std::string uri(const std::string& path) {
  std::string text = "file:///";
  for (const char c : path) {
    char code[4];
    std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned char>(c));
    text += c > ' ' && c != '%' ? std::string(1, c) : code;  // of a byte above 127 too, if char has a sign
  }
  return text;
}

}  // namespace

int main(int, char** arguments) {
  const fs::path folder = fs::temp_directory_path() / u8"n\u00e4del \u91dd";
  fs::create_directories(folder);
  fs::copy_file(arguments[2], folder / "scene.txt", fs::copy_options::overwrite_existing);
  const std::u8string name = folder.generic_u8string();
  const std::string utf8(name.begin(), name.end());
  const HMODULE library = LoadLibraryA(arguments[1]);
  if (!library) return std::puts("the FMU cannot be loaded"), 1;
  const Callbacks callbacks{log2, {}};
  const bool two = function<Make2>(library, "fmi2Instantiate")("", 1, "", uri(utf8).c_str(), &callbacks, 0, 0);
  const bool three = function<Make3>(library, "fmi3InstantiateCoSimulation")("", "", utf8.c_str(), false, false, false,
                                                                             false, nullptr, 0, nullptr, log3, nullptr);
  std::printf("%s: FMI 2 %s, FMI 3 %s\n", utf8.c_str(), two ? "starts" : "FAILS", three ? "starts" : "FAILS");
  return two && three ? 0 : 1;
}
