// Configuration files. Whatever comes in, the options are in their ranges or it is refused.
#include <cstdint>

#include "support/example_options.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const support::TemporaryFolder folder;
  static const std::string path = folder / "run.toml";
  support::write_file(path, {data, data + size});
  support::Example example;
  support::refusal([&] {
    example.parse({"--config", path});
    support::require_admissible(example);
  });
  return 0;
}
