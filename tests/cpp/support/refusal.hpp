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

}  // namespace support
