// The text of a Windows error. Implemented in windows.cpp.
#pragma once

#include <string>

namespace punctura::os {

/// error: of GetLastError() or WSAGetLastError(). Without the full stop and the line break that Windows adds.
std::string windows_words(unsigned long error);

}  // namespace punctura::os
