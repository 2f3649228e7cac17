#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Returns the path of one of Ortung's helper programs: in $ORTUNG_LIBEXEC if that is set, else
/// beside the running program, or where the helpers of libortung_container.so were installed
/// (libexec/ortung) or built.
/// @param about what errors begin with, e.g. the file that is read
/// @throws std::runtime_error naming these places if it is in none of them
ORTUNG_API std::filesystem::path findHelper(const std::string& name, const std::string& about);

/// Runs a program that does what may crash or run away, e.g. reads a file with a foreign library,
/// and returns what it wrote to its standard output. No shell; its standard input and error are
/// /dev/null, other files of ours are closed. It limits its own time and memory.
/// @throws std::runtime_error if it does not start, writes more than @p maxBytes, is ended by a
///   signal, or ends with a status other than 0; then with the text of its last line if that begins
///   with "# error "
ORTUNG_API std::string runHelper(const std::filesystem::path& program,
                                 const std::vector<std::string>& arguments,
                                 const std::string& about, std::size_t maxBytes);

}  // namespace ortung
