#include "NoiseParts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kList = "logs";  ///< text: numbers of sources, and names of their features

std::string arrayName(std::size_t log, const char* what) { return fmt::format("{}.{}", log, what); }
std::string arrayName(std::size_t log, std::size_t feature, const char* what) {
  return fmt::format("{}.{}.{}", log, feature, what);
}

/// Stamps are whole microseconds, which a double holds for three centuries.
void addStamps(TableWriter& file, const std::string& name, const std::vector<double>& stamps) {
  file.add(name, {stamps.size()}, std::span<const double>(stamps));
}

void addReference(TableWriter& file, std::size_t number, const NoiseLog& log) {
  std::vector<double> stamps;
  std::vector<double> poses;
  for (const auto& [stamp, pose] : log.reference) {
    stamps.push_back(static_cast<double>(stamp));
    poses.insert(poses.end(), {pose.x, pose.y, pose.theta});
  }
  addStamps(file, arrayName(number, "stamps"), stamps);
  file.add(arrayName(number, "poses"), {stamps.size(), 3}, std::span<const double>(poses));
}

void addReadings(TableWriter& file, std::size_t number, std::size_t feature,
                 const std::vector<NoiseLog::Reading>& readings) {
  std::vector<double> stamps;
  std::vector<std::int32_t> counts;
  std::vector<std::int32_t> words;
  for (const NoiseLog::Reading& reading : readings) {
    stamps.push_back(static_cast<double>(reading.stamp));
    counts.push_back(static_cast<std::int32_t>(reading.words.size()));
    // NumPy's unsigned words are not among the types of tables; the bits are the same.
    words.insert(words.end(), reading.words.begin(), reading.words.end());
  }
  addStamps(file, arrayName(number, feature, "stamps"), stamps);
  file.add(arrayName(number, feature, "counts"), {counts.size()},
           std::span<const std::int32_t>(counts));
  file.add(arrayName(number, feature, "words"), {words.size()},
           std::span<const std::int32_t>(words));
}

/// Reads stamps, which must not fall. @throws TableError
std::vector<Timestamp> stampsIn(const TableFile& file, const std::string& name) {
  constexpr double kMost = 9e15;  // beyond it not all whole numbers are doubles
  std::vector<Timestamp> stamps;
  for (const double value : file.get<double>(name, {0})) {
    const bool isWhole = std::abs(value) <= kMost && std::trunc(value) == value;
    if (!isWhole || (!stamps.empty() && static_cast<Timestamp>(value) < stamps.back()))
      throw TableError(
          fmt::format("{}: {} has {} as a stamp, expected whole microseconds that rise",
                      file.path().string(), name, value));
    stamps.push_back(static_cast<Timestamp>(value));
  }
  return stamps;
}

std::vector<NoiseLog::Reading> readingsIn(const TableFile& file, std::size_t number,
                                          std::size_t feature) {
  const std::vector<Timestamp> stamps = stampsIn(file, arrayName(number, feature, "stamps"));
  const auto counts = file.get<std::int32_t>(arrayName(number, feature, "counts"), {stamps.size()});
  auto words = file.get<std::int32_t>(arrayName(number, feature, "words"), {0});
  std::vector<NoiseLog::Reading> readings;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const auto count = static_cast<std::size_t>(counts[i]);
    if (counts[i] < 0 || count > words.size())
      throw TableError(file.path().string() + ": has fewer words of readings than it counts");
    readings.push_back({stamps[i], {words.begin(), words.begin() + counts[i]}});
    words = words.subspan(count);
  }
  return readings;
}

NoiseLog logIn(const TableFile& file, std::size_t number, const std::vector<std::string>& names) {
  NoiseLog log;
  const std::vector<Timestamp> stamps = stampsIn(file, arrayName(number, "stamps"));
  const auto poses = file.get<double>(arrayName(number, "poses"), {stamps.size(), 3});
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const Pose2 pose{poses[3 * i], poses[3 * i + 1], poses[3 * i + 2]};
    if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.theta))
      throw TableError(file.path().string() + ": has a pose that is no number");
    log.reference.emplace_back(stamps[i], pose);
  }
  for (std::size_t feature = 0; feature < names.size(); ++feature)
    log.readings[names[feature]] = readingsIn(file, number, feature);
  return log;
}

}  // namespace

void write(const NoisePart& part, PartHead head, const std::filesystem::path& file) {
  PartWriter out(file, std::move(head));
  Json list = Json::array();
  for (const auto& [number, log] : part) {
    addReference(out.content(), number, log);
    Json names = Json::array();
    for (const auto& [name, readings] : log.readings) {
      addReadings(out.content(), number, names.size(), readings);
      names.push_back(name);
    }
    list.push_back({{"source", number}, {"features", names}});
  }
  addLongText(out.content(), kList, list.dump(-1, ' ', true, Json::error_handler_t::replace));
  out.commit();
}

std::vector<NoiseLog> mergeNoiseLogs(const PartSet& parts) {
  std::vector<std::optional<NoiseLog>> all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const TableFile file = parts.open(i);
    const Shard shard{i + 1, parts.size()};
    std::size_t expected = i;
    try {
      for (const Json& one : Json::parse(parts.textOf(i, kList))) {
        const std::size_t number = one.at("source");
        if (number != expected || !shard.has(number))
          throw PartError(
              {fmt::format("part {} has source {}, expected {}", toText(shard), number, expected)});
        expected += parts.size();
        if (number >= all.size()) all.resize(number + 1);
        all[number] = logIn(file, number, one.at("features").get<std::vector<std::string>>());
      }
    } catch (const Json::exception& error) {
      throw PartError(
          {fmt::format("part {} does not say what it has: {}", toText(shard), error.what())});
    }
  }
  std::vector<NoiseLog> logs;
  for (std::optional<NoiseLog>& log : all) {
    if (!log) throw PartError({fmt::format("source {} is in no part", logs.size())});
    logs.push_back(std::move(*log));
  }
  return logs;
}

}  // namespace ortung::app
