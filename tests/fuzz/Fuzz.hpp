#pragma once

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

#include "Files.hpp"

/// What fuzz targets share.
namespace ortung::fuzz {

/// The folder of this process, in memory; the working directory is there, so that what an input
/// names is looked for among the target's own files.
inline const test::TemporaryFolder& folder() {
  static const test::TemporaryFolder kFolder;
  static const bool kIsThere = (std::filesystem::current_path(kFolder.path()), true);
  if (!kIsThere) std::abort();
  return kFolder;
}

inline std::filesystem::path write(const std::string& name, std::string_view bytes) {
  const auto file = folder() / name;
  test::writeBytes(file, std::string(bytes));
  return file;
}

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// A refusal is an exception of one of the types; it says why. Any other ends the process.
template <class... Refusals, class Action>
void refusedOrDone(const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    require((... || (dynamic_cast<const Refusals*>(&error) != nullptr)));
    require(*error.what() != '\0');
  }
}

}  // namespace ortung::fuzz
