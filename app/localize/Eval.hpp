#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "LocalizationArguments.hpp"

namespace ortung::app {

struct EvalArguments {
  LocalizationArguments localization;          ///< its source is not used
  std::vector<std::string> localizationWords;  ///< options of localization as they were given
  std::vector<std::string> sources;            ///< that share robot and tables
  std::size_t runs = 1;                        ///< of each source
  std::size_t kidnaps = 0;                     ///< cases that are made of each source
  std::size_t wakeUps = 0;
  std::optional<double> teleport;  ///< rate of kidnaps within a run [1/m]
  std::filesystem::path json;      ///< JSON to write; "": none
  std::filesystem::path report;    ///< HTML report to write; "": none
  std::filesystem::path record;    ///< record to write; "": none
  std::string convergedWithin = "0.5,15";
  std::vector<std::string> faults;  ///< "WHAT=FAULT[:VALUE][@FROM-TO]"
  std::string commandLine;          ///< for the report
  bool isViewing = false;           ///< show the run afterwards
  std::filesystem::path bound;      ///< world of all sources, whose truth is exact; "" for none
};
int runEval(const EvalArguments& arguments);

}  // namespace ortung::app
