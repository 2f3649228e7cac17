#pragma once

#include <string_view>

/// Contents of files that are linked into the program; see CMakeLists.txt.
namespace ortung::app::assets {

std::string_view uPlotScript();
std::string_view uPlotStyle();
std::string_view uPlotLicence();  ///< MIT; it asks to be part of every copy
std::string_view reportStyle();
std::string_view reportScript();

}  // namespace ortung::app::assets
