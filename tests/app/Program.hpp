#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace ortung::test {

/// What a program left behind.
struct Outcome {
  int exitCode = -1;  ///< 128 + signal if one killed it
  std::string out;
  std::string err;
};

/// A running program whose output is read through pipes.
class Program {
 public:
  /// @param environment "KEY=value" additions
  /// @param output where stdout goes: a file, "closed", or "left": a pipe without a reader; "": it
  /// is
  ///   read
  explicit Program(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {},
                   const std::string& output = "");
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Reads until stderr contains @p text; false if it ended before.
  bool waitForError(const std::string& text);
  /// The same for stdout; returns all of it so far.
  std::string waitForOutput(const std::string& text);
  void signal(int number) const;  ///< after SIGSTOP it has stopped
  Outcome finish();

 private:
  bool readSome();
  pid_t process_ = -1;
  int out_ = -1;
  int err_ = -1;
  Outcome outcome_;
};

/// Runs `ortung` to its end.
Outcome ortung(const std::vector<std::string>& arguments,
               const std::vector<std::string>& environment = {}, const std::string& output = "");

}  // namespace ortung::test
