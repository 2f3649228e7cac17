#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/devices/BaseLines.hpp"

namespace ortung {

/// A helper program that prints lines for as long as it runs. Its standard input and error are
/// /dev/null, other files of ours are closed; it is killed when this ends. Not thread-safe.
class ORTUNG_API ChildProcess {
 public:
  /// @throws std::runtime_error if it does not start
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               std::size_t longestLine);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The next line without its end, having waited for it until @p patience is over, or nothing.
  /// @throws DeviceAbsent saying how it ended, if it has
  std::optional<std::string> next(std::chrono::milliseconds patience);
  /// A line that has come already, or nothing; never waits.
  std::optional<std::string> next() { return lines_.next(); }

 private:
  [[noreturn]] void failAtEnd();
  std::string name_;
  LineCutter lines_;
  pid_t child_ = 0;
  int output_ = -1;
};

}  // namespace ortung
