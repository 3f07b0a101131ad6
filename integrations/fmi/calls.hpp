// Which function may be called when: the state machines of FMI 2.0 (4.2.4) and 3.0 (2.3) for co-simulation.
#pragma once

#include <cstdint>
#include <string>

namespace punctura_fmi {

enum class State : std::int32_t { instantiated, initialization, running, ended };

inline constexpr const char* state_words[] = {"before the initialization", "during the initialization",
                                              "between initialization and end", "after the end"};

/// The kinds of calls that both versions have.
enum class Call { setup, enter, leave, set, get, derive, step, terminate, reset, state };

/// Where a call is allowed, and the state after it.
struct Rule {
  Call call;
  bool allowed[4];  ///< by State
  State next;
  bool moves = true;
};

inline constexpr Rule rules[] = {
    // instantiated, initialization, running, ended
    {Call::setup, {true, false, false, false}, State::instantiated},
    {Call::enter, {true, false, false, false}, State::initialization},
    {Call::leave, {false, true, false, false}, State::running},
    {Call::set, {true, true, true, false}, {}, false},
    {Call::get, {false, true, true, true}, {}, false},
    {Call::derive, {true, true, true, false}, {}, false},
    {Call::step, {false, false, true, false}, State::running},
    {Call::terminate, {false, false, true, false}, State::ended},
    {Call::reset, {true, true, true, true}, State::instantiated},
    {Call::state, {true, true, true, true}, {}, false},
};

constexpr const Rule& rule_of(Call call) {
  for (const Rule& rule : rules)
    if (rule.call == call) return rule;
  return rules[0];
}

/// Why `function` may not be called now; "" if it may.
inline std::string out_of_order(const Rule& rule, State now, const char* function) {
  if (rule.allowed[static_cast<int>(now)]) return "";
  std::string allowed;
  for (int i = 0; i < 4; ++i)
    if (rule.allowed[i]) allowed += (allowed.empty() ? "" : " or ") + std::string(state_words[i]);
  return std::string(function) + " was called " + state_words[static_cast<int>(now)] + "; it is allowed only " +
         allowed;
}

}  // namespace punctura_fmi
