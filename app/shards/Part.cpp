#include "Part.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "ContentDigest.hpp"
#include "ProgramFiles.hpp"
#include "ortung/base/InputFile.hpp"
#include "ortung/container/Abi.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kFormat = "ortung part 1";
/// The first member, so that the kind of file can be recognized by its beginning.
constexpr const char* kMark = "ortung-part.txt";
constexpr const char* kHead = "part.json";

/// Returns the name of a file as another machine may have it, too: from the working folder.
std::string nameOf(const fs::path& file) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const fs::path relative = fs::absolute(file, error).lexically_relative(here);
  const bool isInside = !relative.empty() && *relative.begin() != "..";
  return (isInside ? relative : file).string();
}

std::map<std::string, std::string> digestsOfInputs() {
  std::map<std::string, std::string> digests;
  std::error_code error;
  for (const fs::path& file : allInputs())
    // What is gone was a file for this run alone.
    if (fs::exists(file, error)) digests[nameOf(file)] = digestOfFile(file);
  return digests;
}

}  // namespace

std::string PartHead::versionHere() { return ORTUNG_VERSION " " ORTUNG_CONTAINER_ABI; }

PartWriter::PartWriter(const fs::path& file, PartHead head)
    : head_(std::move(head)), content_(file) {
  content_.addText(kMark, head_.kind + " " + toText(head_.shard) + "\n");
}

void PartWriter::commit() {
  head_.inputs = digestsOfInputs();
  head_.programs = digestsOfProgram();
  const Json json = {{"format", kFormat},
                     {"kind", head_.kind},
                     {"version", head_.version},
                     {"shard", head_.shard.number},
                     {"shards", head_.shard.count},
                     {"job", Json::parse(head_.job)},
                     {"needs", Json::parse(head_.needs)},
                     {"inputs", head_.inputs},
                     {"programs", head_.programs}};
  content_.addText(kHead, json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n");
  content_.commit();
}

PartHead headOf(const TableFile& part) {
  const std::string file = part.path().string();
  try {
    const Json json = Json::parse(part.text(kHead));
    if (!json.is_object() || json.value("format", "") != kFormat)
      throw TableError(file + ": is no part of this version, expected the format '" +
                       std::string(kFormat) + "'");
    PartHead head;
    head.kind = json.at("kind");
    head.version = json.at("version");
    head.shard.number = json.at("shard").get<std::uint64_t>();
    head.shard.count = json.at("shards").get<std::uint64_t>();
    if (!json.at("job").is_object() || !json.at("needs").is_object())
      throw TableError(file + ": its head lacks job or needs");
    head.job = json.at("job").dump();
    head.needs = json.at("needs").dump();
    head.inputs = json.at("inputs").get<std::map<std::string, std::string>>();
    head.programs = json.at("programs").get<std::map<std::string, std::string>>();
    if (head.shard.number < 1 || head.shard.number > head.shard.count ||
        head.shard.count > kMostShards)
      throw TableError(file + ": is shard " + toText(head.shard) + ", which does not exist");
    return head;
  } catch (const Json::exception& error) {
    throw TableError(file + ": has a head that can't be read: " + error.what());
  }
}

std::string contentOf(const TableFile& part) {
  ContentDigest digest;
  for (const TableArray& array : part.arrays()) {
    digest.add(array.name);
    digest.add(
        std::string_view(reinterpret_cast<const char*>(array.bytes.data()), array.bytes.size()));
  }
  return digest.text();
}

}  // namespace ortung::app
