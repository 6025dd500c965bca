// A checkpoint or part that was damaged: some bytes overwritten, place and value by place and value, and cut.
#include "program/record_file.hpp"

#include <cstdint>
#include <span>

#include "fuzz/records.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string whole = fuzz::with_checksum(fuzz::whole_file());
  std::string content = whole;
  std::span edits(data, size);
  for (; edits.size() >= 3; edits = edits.subspan(3))
    content[(edits[0] + 256U * edits[1]) % content.size()] = static_cast<char>(edits[2]);
  if (edits.size() == 2) content.resize((edits[0] + 256U * edits[1]) % content.size());
  const bool came_out = fuzz::gives_records(content);
  if (came_out != (content == whole)) std::abort();
  return 0;
}
