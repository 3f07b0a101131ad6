// What Windows says of an error, for the files that ask it. windows.cpp implements it.
#pragma once

#include <string>

namespace punctura::os {

/// Of GetLastError() or WSAGetLastError(), without the full stop and the line's end that Windows adds.
std::string windows_words(unsigned long error);

}  // namespace punctura::os
