#pragma once

#include <filesystem>
#include <vector>

namespace ortung::app {

/// Arguments of `ortung merge`.
struct MergeArguments {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path out;
  std::filesystem::path html;  ///< page of a benchmark; "": none
  bool force = false;          ///< whether to overwrite files of other kinds
  bool progress = false;
};
int runMerge(const MergeArguments& arguments);

}  // namespace ortung::app
