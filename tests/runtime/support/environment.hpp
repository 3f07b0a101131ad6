// Sets an environment variable for the duration of a test.
#pragma once

#include <cstdlib>

namespace punctura::test {

class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { set(value); }
  ~Environment() { set(nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const char* value) const {
#ifdef _WIN32
    _putenv_s(name_, value ? value : "");  // an empty value removes the variable
#else
    value ? setenv(name_, value, 1) : unsetenv(name_);
#endif
  }
  const char* name_;
};

}  // namespace punctura::test
