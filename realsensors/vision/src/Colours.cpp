#include "ortung/vision/Colours.hpp"

#include <algorithm>
#include <cmath>

namespace ortung {
namespace {

constexpr int kHues = 72;  ///< number of bins, each 5 degrees wide
/// Floors are green, in yellowish to bluish light.
constexpr double kFirstFloorHue = 70.0;
constexpr double kLastFloorHue = 200.0;

double hueDistance(double a, double b) {
  const double d = std::abs(std::fmod(a - b, 360.0));
  return std::min(d, 360.0 - d);
}

bool mayBeFloor(const Hsv& colour) {
  return colour.hue >= kFirstFloorHue && colour.hue <= kLastFloorHue && colour.saturation > 0.12 &&
         colour.value > 0.06;
}

/// Calls @p what for every third pixel of the lower half, in both directions.
template <typename What>
void eachLowerPixel(std::span<const ImageView> images, const What& what) {
  for (const ImageView& image : images) {
    if (image.format != PixelFormat::kRgb) continue;
    for (int v = image.size.height / 2; v < image.size.height; v += 3)
      for (int u = 0; u < image.size.width; u += 3) {
        const std::uint8_t* p = image.pixels + 3 * (static_cast<std::size_t>(v) *
                                                        static_cast<std::size_t>(image.size.width) +
                                                    static_cast<std::size_t>(u));
        what(toHsv(p[0], p[1], p[2]));
      }
  }
}

double quantile(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

ColourRange readRange(const Parameters& p, ColourRange range) {
  range.hue = p.numberOr("hue_deg", range.hue, {0.0, 360.0});
  range.hueTolerance = p.numberOr("hue_tolerance_deg", range.hueTolerance, {0.0, 180.0});
  range.minSaturation = p.numberOr("min_saturation", range.minSaturation, {0.0, 1.0});
  range.minValue = p.numberOr("min_value", range.minValue, {0.0, 1.0});
  range.maxValue = p.numberOr("max_value", range.maxValue, {0.0, 1.0});
  range.maxSaturation = p.numberOr("max_saturation", range.maxSaturation, {0.0, 1.0});
  return range;
}

std::string number(double x) {
  const std::string text = std::to_string(std::round(x * 1000.0) / 1000.0);
  return text.substr(0, text.find('.') + 4);
}

std::string toToml(const char* name, const ColourRange& r) {
  return std::string(name) + " = { hue_deg = " + number(r.hue) +
         ", hue_tolerance_deg = " + number(r.hueTolerance) +
         ", min_saturation = " + number(r.minSaturation) + ", min_value = " + number(r.minValue) +
         ", max_value = " + number(r.maxValue) +
         (r.maxSaturation < 1.0 ? ", max_saturation = " + number(r.maxSaturation) : "") + " }\n";
}

}  // namespace

Hsv toHsv(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  const int most = std::max({red, green, blue});
  const int least = std::min({red, green, blue});
  const double span = most - least;
  Hsv out;
  out.value = most / 255.0;
  if (span <= 0.0) return out;
  out.saturation = span / most;
  if (most == red)
    out.hue = 60.0 * (green - blue) / span;
  else if (most == green)
    out.hue = 120.0 + 60.0 * (blue - red) / span;
  else
    out.hue = 240.0 + 60.0 * (red - green) / span;
  if (out.hue < 0.0) out.hue += 360.0;
  return out;
}

bool ColourRange::has(const Hsv& colour) const {
  return colour.saturation >= minSaturation && colour.saturation <= maxSaturation &&
         colour.value >= minValue && colour.value <= maxValue &&
         hueDistance(colour.hue, hue) <= hueTolerance;
}

// Takes the commonest green hue, and as its tolerance the spread of the peak around it.
Colours findColours(std::span<const ImageView> images) {
  Colours colours;
  std::array<double, kHues> weights{};
  eachLowerPixel(images, [&](const Hsv& c) {
    if (mayBeFloor(c)) weights[static_cast<std::size_t>(c.hue / 360.0 * kHues)] += c.saturation;
  });
  const auto peak = std::max_element(weights.begin(), weights.end());
  if (*peak <= 0.0) return colours;
  const double hue = (static_cast<double>(peak - weights.begin()) + 0.5) * 360.0 / kHues;
  std::vector<double> hues;
  std::vector<double> saturations;
  std::vector<double> values;
  eachLowerPixel(images, [&](const Hsv& c) {
    if (!mayBeFloor(c) || hueDistance(c.hue, hue) > 30.0) return;
    hues.push_back(c.hue);
    saturations.push_back(c.saturation);
    values.push_back(c.value);
  });
  ColourRange& floor = colours.floor;
  floor.hue = quantile(hues, 0.5);
  floor.hueTolerance = std::clamp(2.0 * (quantile(hues, 0.9) - quantile(hues, 0.1)), 20.0, 40.0);
  floor.minSaturation = std::clamp(0.5 * quantile(saturations, 0.1), 0.1, 0.5);
  floor.minValue = std::clamp(0.4 * quantile(values, 0.1), 0.03, 0.3);
  return colours;
}

Colours readColours(const Parameters& p) {
  Colours colours;
  colours.floor = readRange(p.table("floor"), colours.floor);
  colours.ball = readRange(p.table("ball"), colours.ball);
  // Another ball may have nothing in common with a pale yellow one.
  const ColourRange pale = *colours.paleBall;
  if (p.has("ball")) colours.paleBall.reset();
  if (p.has("pale_ball")) colours.paleBall = readRange(p.table("pale_ball"), pale);
  return colours;
}

std::string toToml(const Colours& colours) {
  return toToml("floor", colours.floor) + toToml("ball", colours.ball) +
         (colours.paleBall ? toToml("pale_ball", *colours.paleBall) : "");
}

ColourTable::ColourTable(const Colours& colours) {
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const auto channel = [&](int shift) {
      return static_cast<std::uint8_t>((((i >> shift) & 31U) << 3) + 4);
    };
    const Hsv colour = toHsv(channel(10), channel(5), channel(0));
    if (colours.floor.has(colour)) table_[i] |= static_cast<std::uint8_t>(ColourClass::kFloor);
    if (colours.ball.has(colour) || (colours.paleBall && colours.paleBall->has(colour)))
      table_[i] |= static_cast<std::uint8_t>(ColourClass::kBall);
  }
}

}  // namespace ortung
