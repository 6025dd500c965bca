#pragma once

#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace reference {

/// Command line of a simulator, pairs `--name value`. Throws std::out_of_range for a name that is not given.
class Arguments {
 public:
  Arguments(int argc, char** argv) {
    for (int i = 2; i + 1 < argc; i += 2) texts_[argv[i] + 2] = argv[i + 1];
  }

  const std::string& text(const std::string& name) const { return texts_.at(name); }
  double number(const std::string& name) const { return std::stod(text(name)); }
  std::size_t count(const std::string& name) const { return std::stoull(text(name)); }

  /// Numbers separated by commas.
  std::vector<double> list(const std::string& name) const {
    std::istringstream all(text(name));
    std::vector<double> numbers;
    for (std::string each; std::getline(all, each, ',');) numbers.push_back(std::stod(each));
    return numbers;
  }

 private:
  std::map<std::string, std::string> texts_;
};

}  // namespace reference
