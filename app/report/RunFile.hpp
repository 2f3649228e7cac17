#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ortung::app {

/// A run as the JSON of eval tells of it.
struct FiledRun {
  struct Event {
    bool isRight = false;
    double after = 0.0;     ///< [s]; NaN if it was never right
    double readings = 0.0;  ///< NaN if it was never right
  };
  std::string source;
  std::string robot;
  std::uint64_t seed = 0;
  std::string start;  ///< "": of an earlier version
  std::vector<std::string> faults;
  std::string kind = "whole";             ///< of RunKind
  std::uint64_t number = 1;               ///< of its kind
  std::map<std::string, double> figures;  ///< by their keys; NaN for null
  std::vector<Event> events;

  /// What was run, whatever came of it: runs with the same name are compared.
  std::string name() const;
};

/// Reads what `ortung eval --json` wrote, of one run or of many, also of earlier versions.
/// @throws std::runtime_error naming the file, the run, what was found and what was expected
std::vector<FiledRun> readRuns(const std::filesystem::path& file);

}  // namespace ortung::app
