#pragma once

#include <map>
#include <string>

namespace ortung::app {

/// Returns the digests of this program's own files that the process has loaded (libraries and
/// commands of Ortung, not what they stand on), by file name: what two machines compute is the same
/// only if these are. Plugins are not among them; they are inputs.
std::map<std::string, std::string> digestsOfProgram();

/// Returns the digest of a file of this program, whether it is loaded or not; "missing" if there is
/// none of that name beside those that are.
std::string digestOfProgramFile(const std::string& name);

}  // namespace ortung::app
