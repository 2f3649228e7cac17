#pragma once

#include <filesystem>

#include "ViewArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung export html`.
struct ExportHtmlArguments {
  ViewArguments runs;  ///< runs on the page; its serving is not used
  std::filesystem::path out;
  bool force = false;
};
int runExportHtml(const ExportHtmlArguments& arguments);

}  // namespace ortung::app
