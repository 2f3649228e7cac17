#include "ortung/formats/ScanData.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "FormatTools.hpp"
#include "ScanExpectations.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung {
namespace {

constexpr int kMostBeams = 8192;

std::uint32_t wordOf(double range, double maxRange) {
  if (std::isnan(range)) return 0;
  return range >= maxRange ? words::fromMetres(maxRange) + 1
                           : std::max(words::fromMetres(range), 1U);
}

}  // namespace

ScanData::ScanData(SensorId id, const Pose2& mount, const Config& config)
    : LearnedData(std::move(id), mount, expectationsOf(*this, config)), config_(config) {
  if (config.beams < 1 || config.beams > kMostBeams || !(config.angleStep > 0.0) ||
      config.beams * config.angleStep > kTurn + config.angleStep) {
    throw std::invalid_argument("a scan has 1 to 8192 beams that span at most a turn");
  }
  ranges_.assign(static_cast<std::size_t>(config.beams), std::numeric_limits<float>::quiet_NaN());
}

ScanData::~ScanData() = default;

ScanData::Config ScanData::configOf(const Format& format, std::span<const std::uint32_t>) {
  const double beams = format.number("beams");
  if (!(beams >= 1.0 && beams <= kMostBeams && beams == std::floor(beams)))
    throw std::invalid_argument("found a scan of " + format.text("beams") + " beams");
  Config config;
  config.beams = static_cast<int>(beams);
  config.firstAngle = format.angle("first_deg");
  config.angleStep = format.angle("step_deg");
  config.maxRange = format.number("max_m");
  if (format.has("min_m")) config.minRange = format.number("min_m");
  return config;
}

ScanData::Reading ScanData::reading() const {
  return {config_.firstAngle, config_.angleStep, ranges_};
}

void ScanData::encode(std::span<const float> ranges, double maxRange,
                      std::vector<std::uint32_t>& words) {
  words.resize(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i)
    words[i] = wordOf(static_cast<double>(ranges[i]), maxRange);
}

void ScanData::check(std::span<const std::uint32_t> words) const {
  checkWordCount(words, ranges_.size());
}

void ScanData::decode(std::span<const std::uint32_t> words) {
  for (std::size_t i = 0; i < words.size(); ++i) ranges_[i] = static_cast<float>(rangeOf(words[i]));
}

double ScanData::rangeOf(std::uint32_t word) const {
  const double range = words::toMetres(word);
  if (word == 0 || range < config_.minRange) return std::numeric_limits<double>::quiet_NaN();
  return range >= config_.maxRange ? std::numeric_limits<double>::infinity() : range;
}

Format ScanData::format() const {
  Format format(kFormat);
  format.with("beams", config_.beams)
      .withAngle("first_deg", config_.firstAngle)
      .withAngle("step_deg", config_.angleStep)
      .with("max_m", config_.maxRange);
  if (config_.minRange > 0.0) format.with("min_m", config_.minRange);
  return format;
}

std::string ScanData::wordsHelp() const {
  return "[distance mm] of each of " + std::to_string(config_.beams) + " beams from " +
         keyNumber(degrees(config_.firstAngle)) + " deg in steps of " +
         keyNumber(degrees(config_.angleStep)) + " deg; 0: not valid; from " +
         keyNumber(config_.maxRange * 1000) + " on: nothing seen";
}

std::vector<double> ScanData::measured(const Pose2&) const {
  if (sequence() == 0) return {};
  return {ranges_.begin(), ranges_.end()};
}

std::vector<WordValue> ScanData::valuesIn(std::span<const std::uint32_t> words) const {
  std::vector<WordValue> values;
  values.reserve(words.size());
  for (std::size_t i = 0; i < words.size(); ++i)
    values.push_back({.word = i,
                      .entry = i,
                      .kind = ValueKind::kRange,
                      .value = rangeOf(words[i]),
                      .least = config_.minRange,
                      .most = config_.maxRange});
  return values;
}

void ScanData::store(const WordValue& value, std::span<std::uint32_t> words) const {
  words[value.word] = wordOf(value.value, config_.maxRange);
}

}  // namespace ortung
