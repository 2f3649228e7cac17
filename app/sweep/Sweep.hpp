#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung sweep plan`.
struct SweepPlanArguments {
  std::filesystem::path file;
  std::filesystem::path dir;  ///< folder whose costs are known; "": none
};
int runSweepPlan(const SweepPlanArguments& arguments);

/// Arguments of `ortung sweep run`.
struct SweepRunArguments {
  std::filesystem::path file;
  std::filesystem::path dir;
  std::string shard = "1/1";  ///< part of the tasks, "I/N"
  std::string task;           ///< name of the only task; "": all of the shard
  unsigned jobs = 1;          ///< how many tasks run at a time
  bool progress = false;
};
int runSweepRun(const SweepRunArguments& arguments);

/// Arguments of `ortung sweep status`.
struct SweepStatusArguments {
  std::filesystem::path dir;
  bool all = false;  ///< whether to name each task that is not done
};
int runSweepStatus(const SweepStatusArguments& arguments);

/// Arguments of `ortung sweep table`.
struct SweepTableArguments {
  std::filesystem::path dir;
  std::vector<std::string> by;       ///< keys that are kept; none: all but "seed"
  std::vector<std::string> figures;  ///< paths in the figures; none: the usual ones
  std::filesystem::path csv;         ///< CSV to write; "": none
  std::filesystem::path json;        ///< all figures to write; "": none
  std::filesystem::path html;        ///< page to write; "": none
  bool force = false;                ///< whether to overwrite files of other kinds
};
int runSweepTable(const SweepTableArguments& arguments);

}  // namespace ortung::app
