#pragma once

#include <string>

#include "program/errors.hpp"

namespace support {

/// The message of the UsageError that an action throws; empty without one.
template <class Action>
std::string refusal(Action&& action) {
  try {
    action();
  } catch (const lorentz::UsageError& error) {
    return error.what();
  }
  return {};
}

/// Whether the action throws a UsageError whose message begins with this text.
template <class Action>
bool refused_as(const std::string& beginning, Action&& action) {
  return !beginning.empty() && refusal(action).starts_with(beginning);
}

}  // namespace support
