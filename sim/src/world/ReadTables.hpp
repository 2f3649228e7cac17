#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ortung/base/Parameters.hpp"

namespace ortung {

/// Returns the tables of an array in a world or scene file. @throws ConfigError if there are too
/// many
inline std::vector<Parameters> readTables(const Parameters& file, const char* key,
                                          std::size_t most) {
  auto tables = file.tables(key);
  if (tables.size() > most)
    file.fail(key, "there are " + std::to_string(tables.size()) + ", expected at most " +
                       std::to_string(most));
  return tables;
}

}  // namespace ortung
