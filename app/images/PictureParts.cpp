#include "PictureParts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ortung/base/NewFile.hpp"

namespace ortung::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kList = "list";

std::string arrayName(std::size_t number) { return fmt::format("file.{:06}", number); }

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Checks the name of a file in a data set: one of a folder of it, or of none. A hostile part must
/// not write elsewhere. @throws PartError
fs::path checkedName(const std::string& text) {
  const fs::path name = text;
  bool isPlain = !name.empty() && name.is_relative();
  std::size_t depth = 0;
  for (const fs::path& word : name) {
    isPlain = isPlain && word != ".." && word != "." && !word.empty();
    ++depth;
  }
  if (!isPlain || depth > 2)
    throw PartError({"a part has a file named '" + text + "', expected one of a data set"});
  return name;
}

/// Places the annotations of a part's pictures by number.
void takeAnnotations(const Json& list, const Shard& shard,
                     std::vector<std::optional<std::string>>& all) {
  for (const Json& picture : list.at("pictures")) {
    const auto number = picture.at("number").get<std::uint64_t>();
    constexpr std::uint64_t kMost = 100'000'000;
    if (number >= kMost || !shard.has(number))
      throw PartError(
          {fmt::format("part {} has picture {}, which belongs to another", toText(shard), number)});
    if (number >= all.size()) all.resize(number + 1);
    all[number] = picture.at("annotation").get<std::string>();
  }
}

}  // namespace

void writePictures(const PictureSet& set, const fs::path& folder, PartHead head,
                   const fs::path& file) {
  PartWriter part(file, std::move(head));
  Json list = {{"files", Json::array()}, {"pictures", Json::array()}};
  std::vector<fs::path> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(folder));
  std::sort(names.begin(), names.end());
  for (const fs::path& name : names) {
    addLongText(part.content(), arrayName(list["files"].size()), bytesOf(folder / name));
    list["files"].push_back(name.string());
  }
  for (std::size_t i = 0; i < set.numbers().size(); ++i)
    list["pictures"].push_back(
        {{"number", set.numbers()[i]}, {"annotation", set.annotations()[i]}});
  addLongText(part.content(), kList, list.dump(-1, ' ', true, Json::error_handler_t::replace));
  part.commit();
}

std::size_t mergePictures(const PartSet& parts, const fs::path& folder, bool force) {
  makePictureFolder(folder, force);
  std::vector<std::optional<std::string>> found;
  try {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Json list = Json::parse(parts.textOf(i, kList));
      takeAnnotations(list, {i + 1, parts.size()}, found);
      const TableFile part = parts.open(i);
      std::size_t number = 0;
      for (const Json& name : list.at("files"))
        writeFile(folder / checkedName(name.get<std::string>()),
                  std::as_bytes(part.get<std::uint8_t>(arrayName(number++), {0})));
    }
  } catch (const Json::exception& error) {
    throw PartError({std::string("a part has a list that can't be read: ") + error.what()});
  }
  std::vector<std::string> annotations;
  for (std::optional<std::string>& one : found) {
    if (!one) throw PartError({fmt::format("picture {} is in no part", annotations.size())});
    annotations.push_back(std::move(*one));
  }
  writeFile(folder / kAnnotations, annotationsYaml(annotations));
  return annotations.size();
}

}  // namespace ortung::app
