#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "LocalizationArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung eval`.
struct EvalArguments {
  LocalizationArguments localization;          ///< its source is not used
  std::vector<std::string> localizationWords;  ///< options of localization as they were given
  std::vector<std::string> sources;            ///< sources, which share robot and tables
  std::size_t runs = 1;                        ///< number of runs of each source
  std::size_t kidnaps = 0;                     ///< number of kidnaps made from each source
  std::size_t wakeUps = 0;                     ///< number of wake-ups made from each source
  std::optional<double> teleport;              ///< rate of kidnaps within a run [1/m]
  std::filesystem::path json;                  ///< JSON to write; "": none
  std::filesystem::path report;                ///< HTML report to write; "": none
  std::filesystem::path record;                ///< record to write; "": none
  std::string convergedWithin = "0.5,15";
  std::vector<std::string> faults;  ///< faults of readings, "WHAT=FAULT[:VALUE][@FROM-TO]"
  std::string commandLine;          ///< the command line, for the report
  bool isViewing = false;           ///< whether to show the run afterwards
  bool timesNothing = false;        ///< whether to leave out how long updates took
  std::string shard;                ///< part of the work, "I/N"; "": all of it
  std::string job;                  ///< all options on which the figures depend, as JSON
  std::filesystem::path bound;      ///< world of all sources, for the bound; "": none
};
int runEval(const EvalArguments& arguments);

}  // namespace ortung::app
