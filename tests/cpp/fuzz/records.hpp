#pragma once

#include <fmt/format.h>
#include <zlib.h>

#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "program/record_file.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace fuzz {

using namespace lorentz;

inline const RecordFile format("sigma = 0.5\n", {{"a", "1", "A number"},
                                                 {"b", "momentum", "A pair", {{"i", "1", "", {0, 1}}}}});

constexpr std::size_t checksum_digits = 8;

/// What a file holds before its checksum.
inline std::string whole_file() {
  const std::vector<std::byte> bytes = format.content({{0, {{1, 2, 3}, 4}}, {7, {{5, 6, 7}, 8}}});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size() - checksum_digits};
}

inline std::string with_checksum(const std::string& content) {
  const auto* bytes = reinterpret_cast<const Bytef*>(content.data());
  return content + fmt::format("{:08x}", ::crc32_z(0, bytes, content.size()));
}

/// Whether a file with this content is not refused. Ends the process if other than records of three numbers
/// come out.
inline bool gives_records(const std::string& content) {
  static const support::TemporaryFolder folder;
  static const std::string path = folder / "records";
  support::write_file(path, content);
  return support::refusal([&] {
           for (const auto& [index, record] : format.read(path))
             if (record.values.size() != 3) std::abort();
         })
      .empty();
}

}  // namespace fuzz
