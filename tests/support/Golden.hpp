#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "Files.hpp"
#include "Paths.hpp"

namespace ortung::test {

/// A file of tests/data: a format as it was written when it was new. Today's reader must understand
/// it; so a file that is there is never changed. A new version of a format gets a new one.
inline std::filesystem::path goldenFile(const std::string& name) {
  return std::filesystem::path(ORTUNG_SOURCE_DIR) / "tests" / "data" / name;
}

/// That today's writer makes the same bytes. One that is not there yet is made if the environment
/// has ORTUNG_NEW_GOLDEN, to be looked at and committed.
inline void expectGolden(const std::string& name, const std::string& bytes) {
  const auto file = goldenFile(name);
  if (!std::filesystem::exists(file) && std::getenv("ORTUNG_NEW_GOLDEN") != nullptr)
    writeBytes(file, bytes);
  ASSERT_TRUE(std::filesystem::exists(file)) << file;
  // Not EXPECT_EQ: some are binary.
  EXPECT_TRUE(readBytes(file) == bytes)
      << name << " is written otherwise than when its format was new:\n"
      << (bytes.find('\0') == bytes.npos ? bytes : std::to_string(bytes.size()) + " bytes");
}

}  // namespace ortung::test
