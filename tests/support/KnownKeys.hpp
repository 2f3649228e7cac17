#pragma once

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

namespace ortung::test {

/// The keys that @p error names as known, which must be that about @p unknown.
inline std::set<std::string> keysKnownIn(const std::string& error, const std::string& unknown) {
  EXPECT_NE(error.find(unknown + " is not known here"), error.npos) << error;
  const std::string begin = "; known are ";
  const std::size_t at = error.find(begin);
  EXPECT_NE(at, error.npos) << error;
  std::set<std::string> keys;
  std::istringstream rest(at == error.npos ? "" : error.substr(at + begin.size()));
  for (std::string key; rest >> key;) keys.insert(key.substr(0, key.find(',')));
  return keys;
}

}  // namespace ortung::test
