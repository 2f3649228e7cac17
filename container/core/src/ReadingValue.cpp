#include "ortung/core/ReadingValue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "ortung/base/Words.hpp"

namespace ortung {
namespace {

constexpr double kUsualRange = 20.0;  ///< [m]

struct Meaning {
  std::string_view text;
  ValueKind kind;
};
constexpr std::array<Meaning, 9> kMeanings = {{
    {"other", ValueKind::kOther},
    {"identity", ValueKind::kIdentity},
    {"range_mm", ValueKind::kRange},
    {"bearing_cdeg", ValueKind::kBearing},
    {"x_mm", ValueKind::kX},
    {"y_mm", ValueKind::kY},
    {"heading_cdeg", ValueKind::kHeading},
    {"radius_mm", ValueKind::kRadius},
    {"colour", ValueKind::kColour},
}};

double valueOf(ValueKind kind, std::uint32_t word) {
  switch (kind) {
    case ValueKind::kRange:
    case ValueKind::kRadius:
      return words::toMetres(word);
    case ValueKind::kX:
    case ValueKind::kY:
      return words::toSignedMetres(word);
    case ValueKind::kBearing:
    case ValueKind::kHeading:
      return words::toAngle(word);
    case ValueKind::kOther:
    case ValueKind::kIdentity:
    case ValueKind::kColour:
      break;
  }
  return word;
}

/// Sets the bounds of a value.
void bound(WordValue& value, double maxRange) {
  if (isAngle(value.kind)) {
    value.most = std::numbers::pi;
    value.least = -value.most;
  } else if (isLength(value.kind)) {
    value.most = maxRange;
    const bool isSigned = value.kind == ValueKind::kX || value.kind == ValueKind::kY;
    value.least = isSigned ? -maxRange : 0.0;
  }
}

}  // namespace

std::vector<ValueKind> rowOf(const Format& format) {
  if (!format.has("row")) return {};
  std::vector<ValueKind> row;
  for (const std::string& text : format.list("row")) {
    const auto* const found = std::find_if(kMeanings.begin(), kMeanings.end(),
                                           [&](const Meaning& one) { return one.text == text; });
    row.push_back(found == kMeanings.end() ? ValueKind::kOther : found->kind);
  }
  return row;
}

std::vector<WordValue> valuesOfRows(const Format& format, std::span<const std::uint32_t> words) {
  const std::vector<ValueKind> row = rowOf(format);
  std::vector<WordValue> values;
  if (row.empty()) return values;
  const double maxRange = format.has("max_m") ? format.number("max_m") : kUsualRange;
  for (std::size_t i = 0; i < words.size() - words.size() % row.size(); ++i) {
    const ValueKind kind = row[i % row.size()];
    values.push_back(
        {.word = i, .entry = i / row.size(), .kind = kind, .value = valueOf(kind, words[i])});
    bound(values.back(), maxRange);
  }
  return values;
}

bool isAngleOfRow(const Format& format, std::size_t index) {
  std::vector<ValueKind> row = rowOf(format);
  std::erase_if(row, [](ValueKind kind) { return !isAngle(kind) && !isLength(kind); });
  return !row.empty() && isAngle(row[index % row.size()]);
}

std::vector<double> lengthsAndAngles(std::span<const WordValue> values) {
  std::vector<double> numbers;
  for (const WordValue& one : values)
    if (isAngle(one.kind) || isLength(one.kind)) numbers.push_back(one.value);
  return numbers;
}

std::uint32_t wordOf(const WordValue& value) {
  if (isAngle(value.kind)) return words::fromAngle(value.value);
  if (value.kind == ValueKind::kX || value.kind == ValueKind::kY)
    return words::fromSignedMetres(value.value);
  // If the value is no length, its number is the word.
  return words::fromMetres(isLength(value.kind) ? value.value : value.value / 1000.0);
}

}  // namespace ortung
