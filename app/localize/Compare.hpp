#pragma once

#include <filesystem>

namespace ortung::app {

/// Arguments of `ortung compare`.
struct CompareArguments {
  std::filesystem::path before;  ///< JSON of eval
  std::filesystem::path after;
  std::filesystem::path json;  ///< JSON to write; "": none
  bool force = false;          ///< whether to overwrite files of other kinds
};
int runCompare(const CompareArguments& arguments);

}  // namespace ortung::app
