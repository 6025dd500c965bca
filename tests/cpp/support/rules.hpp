#pragma once

#include "model/rules.hpp"

namespace support {

/// A rule, with options at 0.3 of their ranges.
inline lorentz::RuleChoice example(const lorentz::RuleProperties& rule) {
  lorentz::RuleChoice choice{rule.name};
  for (const lorentz::RuleOption& option : rule.options)
    choice.options.push_back(option.low + 0.3 * (option.high - option.low));
  return choice;
}

}  // namespace support
