#pragma once

#include <string_view>

/// Contents of files that are linked into the program; see CMakeLists.txt.
namespace ortung::app::assets {

std::string_view dygraphsScript();  ///< dygraphs, MIT
std::string_view dygraphsStyle();
std::string_view synchronizerScript();  ///< synchronizer of dygraphs, MIT
std::string_view reportStyle();
std::string_view reportScript();

/// The notice that dygraphs' licence asks for.
inline constexpr std::string_view kDygraphsNotice =
    "Charts: dygraphs, copyright (c) 2006-2023 Dan Vanderkam, Paul Felix, Robert Konigsberg, "
    "David Eberlein, Google Inc., mirabilos, Petr Shevtsov and contributors; MIT licence, "
    "https://github.com/danvk/dygraphs/blob/v2.2.1/LICENSE.txt";

}  // namespace ortung::app::assets
