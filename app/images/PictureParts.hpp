#pragma once

#include <cstddef>
#include <filesystem>

#include "PartSet.hpp"
#include "PictureSet.hpp"

namespace ortung::app {

inline constexpr const char* kPictureParts = "images";  ///< kind of the parts

/// Writes the pictures of a shard as a part. @param folder the folder of the set
void writePictures(const PictureSet& set, const std::filesystem::path& folder, PartHead head,
                   const std::filesystem::path& file);

/// Writes the pictures of all parts into a folder, as one process does. @returns how many
/// @throws PartError
std::size_t mergePictures(const PartSet& parts, const std::filesystem::path& folder, bool force);

}  // namespace ortung::app
