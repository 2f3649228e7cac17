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

/// A child process that prints lines for as long as it runs. Its standard input and error are
/// /dev/null, it inherits no other files, and the destructor kills it. Not thread-safe.
class ORTUNG_API ChildProcess {
 public:
  /// Starts the program.
  /// @param longestLine greatest length of a line [bytes]; longer ones are dropped
  /// @throws std::runtime_error if it does not start
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               std::size_t longestLine);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Returns the next line without its end; waits for it for at most @p patience, then nothing.
  /// @throws DeviceAbsent saying how the process ended, if it has
  std::optional<std::string> next(std::chrono::milliseconds patience);
  /// Returns a line that has arrived already, or nothing; never waits.
  std::optional<std::string> next() { return lines_.next(); }

 private:
  [[noreturn]] void failAtEnd();
  std::string name_;  ///< program, for errors
  LineCutter lines_;
  pid_t child_ = 0;  ///< process; 0: it has ended
  int output_ = -1;  ///< descriptor of its standard output
};

}  // namespace ortung
