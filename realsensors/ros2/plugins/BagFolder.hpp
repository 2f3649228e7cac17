#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ortung::ros2 {

/// Returns the files of a bag in their order: @p path itself, or of a folder those that rosbag2's
/// metadata.yaml names there; without it, those that are called as files of bags, of MCAP if there
/// are some, bag_2.mcap before bag_10.mcap.
/// @param remarks gets what the user should know
/// @throws std::runtime_error if there is none, or if they are compressed in an unknown way
std::vector<std::filesystem::path> bagFiles(const std::filesystem::path& path,
                                            std::vector<std::string>& remarks);

}  // namespace ortung::ros2
