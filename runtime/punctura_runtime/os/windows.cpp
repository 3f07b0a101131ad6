// Windows 10, version 1803, or later.
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
// These need windows.h before them.
#include <avrt.h>
#include <timeapi.h>

#include <algorithm>
#include <string>

#include "punctura_runtime/os/os.hpp"

#ifndef CREATE_WAITABLE_TIMER_HIGH_RESOLUTION
#define CREATE_WAITABLE_TIMER_HIGH_RESOLUTION 0x00000002
#endif

namespace punctura::os {

std::string windows_words(unsigned long error) {
  char* text = nullptr;
  const DWORD length =
      FormatMessageA(FORMAT_MESSAGE_ALLOCATE_BUFFER | FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS,
                     nullptr, error, 0, reinterpret_cast<char*>(&text), 0, nullptr);
  std::string words(text ? text : "", text ? length : 0);
  LocalFree(text);
  while (!words.empty() && (words.back() == '\n' || words.back() == '\r' || words.back() == '.')) words.pop_back();
  return words.empty() ? "error " + std::to_string(error) : words;
}

namespace {

RealtimeItem item(const std::string& what, bool granted) {
  return {what, granted, granted ? "" : windows_words(GetLastError())};
}

void WINAPI close_timer(void* timer) {
  if (timer) CloseHandle(timer);
}

/// This thread's high-resolution timer; nullptr before Windows 10, version 1803. Windows closes it when the thread
/// ends: a thread_local object would not do, since mingw-w64 destroys it after its memory has been freed.
HANDLE precise_timer() noexcept {
  static const DWORD slot = FlsAlloc(close_timer);
  if (slot == FLS_OUT_OF_INDEXES) return nullptr;
  HANDLE timer = FlsGetValue(slot);
  if (!timer) {
    timer = CreateWaitableTimerExW(nullptr, nullptr, CREATE_WAITABLE_TIMER_HIGH_RESOLUTION, TIMER_ALL_ACCESS);
    FlsSetValue(slot, timer);
  }
  return timer;
}

/// Without a high-resolution timer Windows wakes every 15.6 ms, or every 1 ms on request.
void sleep_for(std::int64_t ns) noexcept {
  HANDLE timer = precise_timer();
  LARGE_INTEGER due;
  due.QuadPart = -(ns / 100);  // relative, in 100 ns
  if (timer && SetWaitableTimer(timer, &due, 0, nullptr, nullptr, FALSE)) {
    WaitForSingleObject(timer, INFINITE);
    return;
  }
  static const MMRESULT fine = timeBeginPeriod(1);
  static_cast<void>(fine);
  Sleep(static_cast<DWORD>(ns / 1'000'000));
}

}  // namespace

std::int64_t now_ns() noexcept {  // the performance counter goes on while the computer sleeps
  static const std::int64_t frequency = [] {
    LARGE_INTEGER f;
    QueryPerformanceFrequency(&f);
    return f.QuadPart;
  }();
  LARGE_INTEGER count;
  QueryPerformanceCounter(&count);
  return count.QuadPart / frequency * 1'000'000'000 + count.QuadPart % frequency * 1'000'000'000 / frequency;
}

void sleep_until_ns(std::int64_t time) noexcept {
  for (std::int64_t left = time - now_ns(); left > 0; left = time - now_ns()) {
    if (left > 100'000)
      sleep_for(left - 50'000);
    else
      YieldProcessor();  // the last tenth of a millisecond: no timer is that accurate
  }
}

std::vector<RealtimeItem> make_realtime(const RealtimeSettings& settings) {
  std::vector<RealtimeItem> items;
  if (settings.priority > 0) {
    DWORD index = 0;
    items.push_back(
        item("multimedia class 'Pro Audio'", AvSetMmThreadCharacteristicsA("Pro Audio", &index) != nullptr));
    items.push_back(
        item("time-critical priority", SetThreadPriority(GetCurrentThread(), THREAD_PRIORITY_TIME_CRITICAL) != 0));
  }
  if (settings.processor >= 0) {
    const auto wanted = static_cast<unsigned>(settings.processor);
    const DWORD_PTR mask =
        wanted < 8 * sizeof(DWORD_PTR) ? DWORD_PTR{1} << wanted : 0;  // higher numbers are in another processor group
    items.push_back(item("processor " + std::to_string(wanted), SetThreadAffinityMask(GetCurrentThread(), mask) != 0));
  }
  if (settings.lock_memory)
    items.push_back(
        {"memory locked", false, "Windows locks single pages only; the loop's own stay in use and so in memory"});
  if (settings.awake)
    items.push_back(item("system kept awake", SetThreadExecutionState(ES_CONTINUOUS | ES_SYSTEM_REQUIRED) != 0));
  return items;
}

void* load_library(const char* name, std::string& error) {
  // The loader takes backslashes only. It finds a library's dependencies beside the library only if it gets the
  // absolute path.
  std::string path = name;
  std::replace(path.begin(), path.end(), '/', '\\');
  DWORD flags = 0;
  if (char whole[MAX_PATH]; path.find('\\') != std::string::npos) {
    const DWORD length = GetFullPathNameA(path.c_str(), MAX_PATH, whole, nullptr);
    if (length > 0 && length < MAX_PATH) path.assign(whole, length), flags = LOAD_WITH_ALTERED_SEARCH_PATH;
  }
  DWORD mode = 0;  // no error dialog
  SetThreadErrorMode(SEM_FAILCRITICALERRORS | SEM_NOOPENFILEERRORBOX, &mode);
  HMODULE handle = LoadLibraryExA(path.c_str(), nullptr, flags);
  if (!handle) error = std::string(name) + ": " + windows_words(GetLastError());
  SetThreadErrorMode(mode, nullptr);
  return reinterpret_cast<void*>(handle);
}

void* library_symbol(void* library, const char* name) noexcept {
  return reinterpret_cast<void*>(GetProcAddress(reinterpret_cast<HMODULE>(library), name));
}

}  // namespace punctura::os
