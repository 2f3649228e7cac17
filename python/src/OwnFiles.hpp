#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "Bindings.hpp"
#include "ortung/base/FileKind.hpp"

namespace ortung::python {

/// Refuses to replace a file that holds something else than what is to be written there, as the
/// program does without --force.
/// @throws FileExistsError
inline void refuseOther(const std::filesystem::path& file, FileKind ours, bool force) {
  std::error_code error;
  if (force || !std::filesystem::is_regular_file(file, error)) return;
  if (std::filesystem::file_size(file, error) == 0 || kindOfFile(file) == ours) return;
  const std::string other = whatItIs(file);
  const std::string text = file.string() + ": is there already, and is not what would be written" +
                           other + "; force=True overwrites it";
  PyErr_SetString(PyExc_FileExistsError, text.c_str());
  throw py::error_already_set();
}

}  // namespace ortung::python
