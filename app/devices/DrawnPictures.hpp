#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Outputs.hpp"
#include "ortung/calibration/ImageFile.hpp"

namespace ortung::app {

/// Returns the file of a picture with drawings; it is announced before any work begins.
std::filesystem::path drawnFile(const std::filesystem::path& folder,
                                const std::filesystem::path& picture);
/// Declares the pictures that are read, makes the folder of drawings, and declares those.
/// @param names names of the drawings; none: those of the pictures
void announceDrawings(Outputs& outputs, const std::filesystem::path& folder,
                      const std::vector<std::filesystem::path>& pictures,
                      const std::vector<std::filesystem::path>& names = {});
void writePng(const Outputs& outputs, const std::filesystem::path& file, const Picture& picture);
/// Writes a table of a robot file, or prints it if there is no file.
void printTable(const Outputs& outputs, const std::filesystem::path& out, const std::string& table);

}  // namespace ortung::app
