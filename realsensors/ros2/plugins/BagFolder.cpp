#include "BagFolder.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "ortung/base/InputFile.hpp"
#include "ortung/realsensors/LogFile.hpp"

namespace ortung::ros2 {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostMetadata = 1U << 22;  // bytes
constexpr std::size_t kMostFiles = 100'000;

/// Returns the text of a scalar, or "".
std::string textOf(const YAML::Node& node) {
  return node && node.IsScalar() ? node.Scalar() : std::string();
}

/// Returns the part of metadata.yaml that tells of the files, or why there is none.
std::optional<YAML::Node> informationOf(const fs::path& yaml, std::string& why) {
  std::ifstream in = openInput(yaml, why);
  if (!in) return std::nullopt;
  std::error_code error;
  if (fs::file_size(yaml, error) > kMostMetadata || error) {
    why = "has more than 4 MiB";
    return std::nullopt;
  }
  try {
    const YAML::Node root = YAML::Load(in);
    if (root.IsMap()) {
      YAML::Node information = root["rosbag2_bagfile_information"];
      if (information && information.IsMap()) return information;
    }
    why = "has no rosbag2_bagfile_information";
  } catch (const YAML::Exception& damage) {
    why = std::string("is not YAML: ") + damage.what();
  }
  return std::nullopt;
}

/// Finds a file that metadata.yaml names: in its folder, whatever folder it had when it was
/// recorded, and packed or unpacked since.
std::optional<fs::path> fileOf(const fs::path& folder, const std::string& name) {
  const fs::path there = folder / fs::path(name).filename();
  fs::path packed = there;
  packed += ".zstd";
  fs::path unpacked = there;
  if (there.extension() == ".zstd") unpacked.replace_extension();
  std::error_code none;
  for (const fs::path& one : {there, packed, unpacked})
    if (fs::is_regular_file(one, none)) return one;
  return std::nullopt;
}

void checkCompression(const YAML::Node& information, const fs::path& yaml) {
  const std::string format = textOf(information["compression_format"]);
  if (!format.empty() && format != "zstd")
    throw std::runtime_error(yaml.string() + ": found files compressed by " + inQuotes(format) +
                             ", expected zstd or nothing");
}

/// Returns the files that metadata.yaml names; none, and a remark, if it does not tell.
std::vector<fs::path> filesByMetadata(const fs::path& folder, std::vector<std::string>& remarks) {
  const fs::path yaml = folder / "metadata.yaml";
  std::error_code none;
  if (!fs::is_regular_file(yaml, none)) return {};
  std::string why;
  std::vector<fs::path> files;
  if (const auto information = informationOf(yaml, why)) {
    checkCompression(*information, yaml);
    const YAML::Node names = (*information)["relative_file_paths"];
    const bool isList = names && names.IsSequence() && names.size() <= kMostFiles;
    for (std::size_t i = 0; isList && i < names.size() && why.empty(); ++i) {
      const std::string name = textOf(names[i]);
      if (auto file = fileOf(folder, name))
        files.push_back(std::move(*file));
      else
        why = "names " + inQuotes(name) + ", which is not there";
    }
    if (files.empty() && why.empty()) why = "names no files";
  }
  if (why.empty()) return files;
  remarks.push_back(yaml.string() + " " + why +
                    "; the folder's files were read as they are called");
  return {};
}

/// Returns the files whose names end in one of some ways.
std::vector<fs::path> filesCalled(const fs::path& folder, const std::vector<std::string>& endings) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const auto isOne = [&](const std::string& ending) {
      return name.size() > ending.size() && name.ends_with(ending);
    };
    if (std::any_of(endings.begin(), endings.end(), isOne)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const auto key = [](const fs::path& p) { return std::pair(p.string().size(), p.string()); };
    return key(a) < key(b);
  });
  return files;
}

}  // namespace

std::vector<fs::path> bagFiles(const fs::path& path, std::vector<std::string>& remarks) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<fs::path> files = filesByMetadata(path, remarks);
  if (!files.empty()) return files;
  const std::vector<std::vector<std::string>> kinds{
      {".mcap"}, {".db3"}, {".mcap.zstd", ".db3.zstd"}, {".bag"}};
  for (const auto& kind : kinds)
    if (files = filesCalled(path, kind); !files.empty()) return files;
  throw std::runtime_error(
      path.string() +
      ": found no file *.mcap, *.db3, *.zstd or *.bag in this folder, expected "
      "those of a bag");
}

}  // namespace ortung::ros2
