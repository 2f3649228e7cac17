#pragma once

#include <memory>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own
class FormatterBase;
}  // namespace CLI

namespace ortung::app {

/// The group of options that every command has; helps list it last.
inline constexpr const char* kGeneral = "General";

/// Returns what formats helps: at most 100 columns, options by their groups, headings in bold on a
/// terminal (unless NO_COLOR is set, see no-color.org).
std::shared_ptr<CLI::FormatterBase> helpFormatter();

}  // namespace ortung::app
