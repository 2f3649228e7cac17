#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "ViewArguments.hpp"

namespace ortung::app {

/// Arguments of `ortung export html`.
struct ExportHtmlArguments {
  ViewArguments runs;  ///< runs on the page; its serving is not used
  /// Moments of each run with maps; nothing: 16 with tables, else none.
  std::optional<std::size_t> maps;
  std::filesystem::path out;
  bool force = false;
};
int runExportHtml(const ExportHtmlArguments& arguments);

}  // namespace ortung::app
