#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ortung::app {

/// A run as the JSON of eval describes it.
struct FiledRun {
  struct Event {
    bool isRight = false;
    double after = 0.0;     ///< time until it was right [s]; NaN: never
    double readings = 0.0;  ///< number of times with readings until then; NaN: never
  };
  std::string source;
  std::string robot;
  std::uint64_t seed = 0;
  std::string start;  ///< start of the belief; "": the file is of an earlier version
  std::vector<std::string> faults;
  std::string kind = "whole";             ///< name of its RunKind
  std::uint64_t number = 1;               ///< number among the runs of its kind
  std::map<std::string, double> figures;  ///< figures by key; NaN for null
  std::vector<Event> events;

  /// Returns a name of what was run; runs with the same name are compared.
  std::string name() const;
};

/// Reads a file of `ortung eval --json` with one run or many, also of earlier versions.
/// @throws std::runtime_error naming the file, the run, what was found and what was expected
std::vector<FiledRun> readRuns(const std::filesystem::path& file);

}  // namespace ortung::app
