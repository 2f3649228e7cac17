#pragma once

#include <filesystem>

#include "ViewArguments.hpp"

namespace ortung::app {

struct ExportHtmlArguments {
  ViewArguments runs;  ///< what is in it; it is not served
  std::filesystem::path out;
  bool force = false;
};
int runExportHtml(const ExportHtmlArguments& arguments);

}  // namespace ortung::app
