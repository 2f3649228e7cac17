#include "PartSet.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "ContentDigest.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// A part as it is in its file.
struct Found {
  fs::path file;
  PartHead head;
  std::string content;  ///< digest of its content
};

std::string shortened(const Json& value) {
  constexpr std::size_t kLongest = 80;
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

/// Returns in what the job of a part differs from that of the others.
std::string differenceOf(const std::string& its, const std::string& others) {
  const Json one = Json::parse(its);
  const Json all = Json::parse(others);
  std::string text;
  const auto add = [&](const std::string& key) {
    const Json mine = one.contains(key) ? one[key] : Json();
    const Json theirs = all.contains(key) ? all[key] : Json();
    if (mine == theirs) return;
    text += fmt::format("{}{} is {}, that of the others {}", text.empty() ? "" : "; ", key,
                        shortened(mine), shortened(theirs));
  };
  for (const auto& [key, value] : one.items()) add(key);
  for (const auto& [key, value] : all.items())
    if (!one.contains(key)) add(key);
  return text;
}

/// Returns which file of the same name is another one; "" if none is.
std::string otherFile(const char* made, const std::map<std::string, std::string>& its,
                      const std::map<std::string, std::string>& others) {
  for (const auto& [name, digest] : its) {
    const auto other = others.find(name);
    if (other != others.end() && other->second != digest)
      return fmt::format("was {} another {} than the others (digest {}, not {})", made, name,
                         digest, other->second);
  }
  return "";
}

/// Returns why a part does not belong to the others; "" if it does.
std::string strangenessOf(const PartHead& head, const PartHead& others) {
  if (head.kind != others.kind)
    return fmt::format("is a part of `{}`, the others are of `{}`", head.kind, others.kind);
  if (head.version != others.version)
    return fmt::format("was made by version {}, the others by {}", head.version, others.version);
  if (head.shard.count != others.shard.count)
    return fmt::format("is shard {}, but the others are of {}", toText(head.shard),
                       others.shard.count);
  if (head.job != others.job) return "is of another job: " + differenceOf(head.job, others.job);
  if (const std::string why = otherFile("made by", head.programs, others.programs); !why.empty())
    return why;
  return otherFile("made from", head.inputs, others.inputs);
}

/// Returns the part to which most others are equal in kind, version and job: who is foreign, the
/// majority decides.
const Found& usualOf(const std::vector<Found>& parts) {
  std::map<std::string, std::size_t> counts;
  const auto keyOf = [](const PartHead& h) {
    return h.kind + "\n" + h.version + "\n" + std::to_string(h.shard.count) + "\n" + h.job;
  };
  for (const Found& part : parts) ++counts[keyOf(part.head)];
  const Found* usual = &parts.front();
  for (const Found& part : parts)
    if (counts[keyOf(part.head)] > counts[keyOf(usual->head)]) usual = &part;
  return *usual;
}

std::vector<Found> readAll(const std::vector<fs::path>& files, std::vector<std::string>& reasons) {
  std::vector<Found> parts;
  for (const fs::path& file : files) {
    try {
      const TableFile part(file);
      parts.push_back({file, headOf(part), contentOf(part)});
    } catch (const TableError& error) {
      reasons.emplace_back(error.what());
    }
  }
  return parts;
}

/// Returns what is not among the shards, as "3/7, 5/7".
std::string missingOf(const std::vector<const Found*>& shards) {
  constexpr std::size_t kMost = 20;
  std::string text;
  std::size_t count = 0;
  for (std::size_t i = 0; i < shards.size(); ++i) {
    if (shards[i] != nullptr || ++count > kMost) continue;
    text += (text.empty() ? "" : ", ") + toText({i + 1, shards.size()});
  }
  if (count > kMost) text += fmt::format(" and {} more", count - kMost);
  return text;
}

std::string allOf(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

PartError::PartError(std::vector<std::string> reasons)
    : std::runtime_error(allOf(reasons)), reasons_(std::move(reasons)) {}

PartSet::PartSet(const std::vector<fs::path>& files) {
  std::vector<std::string> reasons;
  const std::vector<Found> parts = readAll(files, reasons);
  if (parts.empty()) {
    reasons.emplace_back("there is no part");
    throw PartError(reasons);
  }
  const Found& usual = usualOf(parts);
  std::vector<const Found*> shards(usual.head.shard.count, nullptr);
  PartHead known = usual.head;  // with the inputs of all
  for (const Found& part : parts) {
    if (const std::string why = strangenessOf(part.head, known); !why.empty()) {
      reasons.push_back(part.file.string() + ": " + why);
      continue;
    }
    known.inputs.insert(part.head.inputs.begin(), part.head.inputs.end());
    known.programs.insert(part.head.programs.begin(), part.head.programs.end());
    const Found*& place = shards[part.head.shard.number - 1];
    if (place == nullptr) {
      place = &part;
    } else if (place->content != part.content) {
      reasons.push_back(fmt::format("{}: is shard {} as {} is, with another content",
                                    part.file.string(), toText(part.head.shard),
                                    place->file.string()));
    }
  }
  if (usual.head.version != PartHead::versionHere())
    reasons.push_back(fmt::format("{}: was made by version {}, this is {}", usual.file.string(),
                                  usual.head.version, PartHead::versionHere()));
  if (const std::string missing = missingOf(shards); !missing.empty())
    reasons.push_back("missing: " + missing);
  if (!reasons.empty()) throw PartError(reasons);
  head_ = shards.front()->head;
  head_.inputs = known.inputs;
  head_.programs = known.programs;
  for (const Found* part : shards) files_.push_back(part->file);
}

void PartSet::requireInputs() const {
  std::vector<std::string> reasons;
  for (const auto& [name, digest] : head_.inputs) {
    try {
      if (digestOfFile(name) != digest)
        reasons.push_back(name + ": has changed since the parts were made from it");
    } catch (const std::runtime_error& error) {
      reasons.push_back(std::string(error.what()) + "; the parts were made from it");
    }
  }
  if (!reasons.empty()) throw PartError(reasons);
}

std::string PartSet::textOf(std::size_t index, const std::string& name) const {
  const TableFile part(files_.at(index));
  const auto bytes = part.get<std::uint8_t>(name, {0});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void addLongText(TableWriter& file, const std::string& name, const std::string& text) {
  file.add(name, {text.size()},
           std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace ortung::app
