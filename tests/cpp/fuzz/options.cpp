// Command lines, an argument a line. Whatever comes in, the options are in their ranges or it is refused.
#include "program/options.hpp"

#include <cstdint>
#include <sstream>

#include "program/parts.hpp"
#include "support/example_options.hpp"
#include "support/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines(std::string(data, data + size));
  support::Arguments arguments;
  for (std::string line; std::getline(lines, line);) arguments.push_back(line.substr(0, line.find('\0')));
  support::Example example;
  support::refusal([&] {
    if (example.parse(arguments)) support::require_admissible(example);
    if (!arguments.empty()) lorentz::Part::from(arguments.front(), 16);
  });
  return 0;
}
