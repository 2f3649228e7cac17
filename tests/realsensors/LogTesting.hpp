#pragma once

/// What the tests of foreign logs share.

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "ortung/core/Message.hpp"
#include "ortung/core/Source.hpp"

namespace ortung::testing {

/// A folder of one test, gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// Writes a file, folders included; returns its path.
  std::filesystem::path write(const std::string& name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
};

std::string compressedXz(const std::string& text);
std::string compressedGz(const std::string& text);
std::string readBytes(const std::filesystem::path& file);

/// Makes a source as the program does. @param text "KIND:PATH?key=value"
std::unique_ptr<Source> makeSource(const std::string& text);
std::vector<Message> readAll(Source& source);
std::vector<Message> readAll(const std::string& text);
/// Those of one feature. @param id "model/type/feature"
std::vector<Message> only(const std::vector<Message>& messages, const std::string& id);
/// "STAMP ID WORD WORD ..." of each message, for comparison with what a test expects.
std::vector<std::string> asText(const std::vector<Message>& messages);

/// What an action throws, or "" if it does not.
std::string errorOf(const std::function<void()>& action);
std::string errorOf(const std::string& source);
/// What opening and reading the source throws while a file of the folder holds these bytes; then
/// the file is as it was, or gone. Returns "" if nothing is thrown.
std::string errorWith(const TemporaryFolder& folder, const std::string& name,
                      const std::string& bytes, const std::string& source);

/// A few bytes changed, taken out or put in, or the end cut off.
std::string mutated(const std::string& bytes, std::mt19937& random);

/// Folder of real logs, or empty.
std::filesystem::path sharedData(const std::string& name);

}  // namespace ortung::testing

/// Ends the test unless the real log is there.
// NOLINTBEGIN(bugprone-macro-parentheses): a name that is declared has none
#define ORTUNG_NEED_DATA(variable, name)                                    \
  const std::filesystem::path variable = ortung::testing::sharedData(name); \
  if (variable.empty()) GTEST_SKIP() << "real log " << name << " is not here: ../shared/data"
// NOLINTEND(bugprone-macro-parentheses)
