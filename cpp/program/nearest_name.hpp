#pragma once

#include <string>
#include <vector>

namespace lorentz {

/// The first of the names with the least number of letters to insert, delete or replace to make it of the
/// word (Levenshtein). There must be a name.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

}  // namespace lorentz
