#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ortung/container/Export.hpp"

namespace ortung {

/// Where a helper program of ours is: in $ORTUNG_LIBEXEC, beside the running program, or in
/// ../libexec/ortung from there. @throws std::runtime_error naming these places
ORTUNG_API std::filesystem::path findHelper(const std::string& name);

/// Runs a program without a shell and returns what it wrote to its standard output.
/// Its standard input and error are /dev/null.
/// @param about what errors begin with, e.g. the file that is read
/// @throws std::runtime_error if it does not start, writes more than @p maxBytes, is ended by a
///   signal, or ends with a status other than 0; then with the text of its last line if that begins
///   with "# error "
ORTUNG_API std::string runHelper(const std::filesystem::path& program,
                                 const std::vector<std::string>& arguments,
                                 const std::string& about, std::uint64_t maxBytes);

}  // namespace ortung
