#pragma once

#include <string>
#include <vector>

namespace lorentz {

/// A key of a configuration file and its value.
struct ConfigEntry {
  enum class Form { scalar, string, array };

  std::string key = {};
  std::string place = {};  // "run.toml, line 3"
  Form form;
  std::string literal;  // as TOML has it
  std::string text;  // as the command line would have it: a string without quotes, an array without brackets
};

/// The entries of a TOML file. Throws UsageError if it cannot be read or breaks the rules of TOML.
std::vector<ConfigEntry> read_config_file(const std::string& path);

}  // namespace lorentz
