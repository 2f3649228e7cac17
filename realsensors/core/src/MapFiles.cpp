#include "ortung/realsensors/MapFiles.hpp"

#include <cerrno>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "ortung/base/InputFile.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/realsensors/LogFile.hpp"
#include "ortung/realsensors/LogSource.hpp"

namespace ortung {

// Maps of buildings by the robots of public logs are off by about 2 cm: with that, errors of poses
// at scans are those that their covariances promise.
std::string gridKeys(const std::string& map) {
  return "map = " + tomlText(map) + "\nsurface_depth_cells = 0.5\nmap_error_m = 0.02\n";
}

std::string gridToml(const std::string& map) { return "[[grid]]\n" + gridKeys(map); }

namespace {

constexpr std::uint64_t kMaxYamlBytes = 64u << 10;
constexpr std::uint64_t kMaxImageBytes = 512u << 20;

/// Returns the text behind "image:" without quotes and blanks; empty if the line has none.
std::string imageName(const std::string& line) {
  const std::string key = "image:";
  if (line.compare(0, key.size(), key) != 0) return "";
  const char* const blanks = " \t\r\"'";
  const std::size_t begin = line.find_first_not_of(blanks, key.size());
  if (begin == std::string::npos) return "";
  return line.substr(begin, line.find_last_not_of(blanks) - begin + 1);
}

bool isImage(const std::string& bytes) {
  for (const char* kind : {"P2", "P3", "P5", "P6", "\x89PNG"})
    if (bytes.starts_with(kind)) return true;
  return false;
}

std::filesystem::path beside(const std::filesystem::path& world, const std::string& ending) {
  std::filesystem::path file = world;
  return file.replace_extension(ending);
}

void writeWorldText(const std::filesystem::path& world, const std::filesystem::path& map,
                    const std::string& more) {
  writeFile(world, "[world]\nname = " + tomlText(world.stem().string()) + "\n\n" +
                       gridToml(map.filename().string()) + more);
}

/// Copies a map that needs no other file. It keeps its endings (".gridmap.gz"), which give its
/// kind.
void copyMap(const std::filesystem::path& world, const std::filesystem::path& map,
             const std::string& more) {
  std::string ending = map.extension().string();
  if (ending == ".gz") ending = map.stem().extension().string() + ending;
  const auto copy = beside(world, ending);
  std::string why;
  std::ifstream in = openInput(map, why);
  if (!in) throw std::runtime_error(map.string() + ": " + why);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in || !bytes) throw std::runtime_error(map.string() + ": " + cantBeRead(errno));
  writeFile(copy, bytes.str());
  writeWorldText(world, copy, more);
}

/// Copies a map_server YAML and its image, and changes the image's name in it to that of the copy.
void copyMapServer(const std::filesystem::path& world, const std::filesystem::path& map,
                   const std::string& more) {
  std::istringstream yaml(readLogBytes(map, kMaxYamlBytes));
  std::filesystem::path image;
  std::filesystem::path copy;
  std::string text;
  for (std::string line; std::getline(yaml, line);) {
    if (const std::string name = imageName(line); !name.empty()) {
      const auto found = findLogFile(map.parent_path() / name);
      if (!found) {
        throw std::runtime_error(map.string() + ": found no image " + inQuotes(name) +
                                 " beside it, expected one");
      }
      image = *found;
      copy = beside(world, std::filesystem::path(unpackedName(image)).extension().string());
      line = "image: " + copy.filename().string();
    }
    text += line + "\n";
  }
  if (image.empty()) {
    throw std::runtime_error(map.string() + ": found no line 'image: ...', expected one");
  }
  const std::string bytes = readLogBytes(image, kMaxImageBytes);
  if (!isImage(bytes)) {
    throw std::runtime_error(image.string() + ": found no PGM, PPM or PNG image, expected one");
  }
  writeFile(copy, bytes);
  writeFile(beside(world, ".yaml"), text);
  writeWorldText(world, beside(world, ".yaml"), more);
}

}  // namespace

void writeGridWorld(const std::filesystem::path& world, const std::filesystem::path& map,
                    const std::string& more) {
  const bool isYaml = map.extension() == ".yaml" || map.extension() == ".yml";
  isYaml ? copyMapServer(world, map, more) : copyMap(world, map, more);
}

std::string landmarksToml(const std::filesystem::path& path, const std::string& kind) {
  LogFile file(path);
  std::string text;
  const Range metres{-kMaxLogMetres, kMaxLogMetres};
  while (file.nextRecord()) {
    if (file.size() < 3) file.needFields(3, "identity, x, y [m]");
    text += "\n[[landmark]]\nkind = " + tomlText(kind) +
            "\nidentity = " + std::to_string(file.integer(0, "an identity", {0, 1e6})) +
            "\nposition_m = [" + tomlNumber(file.number(1, "x [m]", metres)) + ", " +
            tomlNumber(file.number(2, "y [m]", metres));
    if (file.size() > 3) text += ", " + tomlNumber(file.number(3, "z [m]", metres));
    text += "]\n";
  }
  return text;
}

std::filesystem::path fileOption(const Parameters& options, const std::string& key,
                                 const std::filesystem::path& folder) {
  if (!options.has(key)) return {};
  const std::string name = options.text(key);
  for (const std::filesystem::path& file : {folder / name, std::filesystem::path(name)}) {
    if (const auto found = findLogFile(file)) return *found;
  }
  options.fail(key, "found no file " + inQuotes(name) + " in " + folder.string() +
                        " or the working directory, expected one (it may end in .xz or .gz)");
}

}  // namespace ortung
