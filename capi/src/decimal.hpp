// Numbers from decimal text, also with a standard library that cannot read a double with std::from_chars.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#include <cerrno>
#include <cmath>
#include <cstdlib>
#endif

namespace punctura::c {

/// Reads the whole text as a number, correctly rounded. The result is std::errc() if that is possible, and
/// result_out_of_range if the number is too large or too small for a double.
///
/// LLVM's library has no std::from_chars for double before version 20. There std::strtod reads it, so a program must
/// not change the decimal point of its C locale. WebAssembly has the locale "C" only.
inline std::errc read_decimal(std::string_view text, double& number) {
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
  // What strtod accepts beyond std::from_chars: leading space, a leading +, hexadecimal numbers.
  const std::string whole(text);
  if (whole.empty() || whole.find_first_of(" \t\n\v\f\r+xX") < whole.find_first_of("eE"))
    return std::errc::invalid_argument;
  char* end = nullptr;
  errno = 0;
  const double read = std::strtod(whole.c_str(), &end);
  if (end != whole.c_str() + whole.size()) return std::errc::invalid_argument;
  if (errno == ERANGE && (read == 0 || std::isinf(read))) return std::errc::result_out_of_range;
  number = read;
  return std::errc();
#else
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end != text.data() + text.size() ? std::errc::invalid_argument : error;
#endif
}

}  // namespace punctura::c
