#pragma once

#include <filesystem>
#include <functional>

namespace ortung::ros2 {

/// Learns tables by the program `ortung learn`, which lies beside this one or in the PATH.
/// @param goOn asked now and then; if it says no, the program is ended
/// @return whether there are tables now @throws std::runtime_error if it fails
bool learnTables(const std::filesystem::path& world, const std::filesystem::path& robot,
                 const std::filesystem::path& tables, const std::function<bool()>& goOn);

}  // namespace ortung::ros2
