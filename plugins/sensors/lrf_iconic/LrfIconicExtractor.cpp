#include "LrfIconicExtractor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "ScanForecast.hpp"
#include "WallMatcher.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung {

LrfIconicExtractor::LrfIconicExtractor(const Parameters& p) : settings_(readLrfIconicSettings(p)) {}

LrfIconicExtractor::~LrfIconicExtractor() = default;

std::vector<std::string> LrfIconicExtractor::inputs() const {
  if (!settings_.reads.empty()) return {settings_.reads};
  SensorId scan = settings_.id;
  scan.feature = LrfIconicSettings::kScan;
  return {toText(scan)};
}

void LrfIconicExtractor::take(std::span<const SensorData* const> inputs) {
  auto scan = readingAs<ScanData>(*inputs[0]);
  if (!scan) throw std::invalid_argument(toText(inputs[0]->id()) + " is not a scan, expected one");
  scan_ = *std::move(scan);
  mount_ = inputs[0]->mount();
  maxRange_ = ScanData::configOf(inputs[0]->format()).maxRange;
}

void LrfIconicExtractor::extract(const FieldModel& field, std::span<std::optional<Words>> words) {
  const ScanShapes shapes =
      shapesOf(scan_.ranges, scan_.firstAngle, scan_.angleStep, settings_.shapes);
  const WallMatcher& matcher = matcherOf(field);
  const std::vector<std::uint8_t> small = beamsOnCircles(shapes);
  const std::vector<PoseFixData::Fix> fixes = matcher.match(
      shapes.segments, {scan_.ranges, small, scan_.firstAngle, scan_.angleStep, maxRange_}, mount_);
  words[0] = ObstaclesData::encode(obstacles(shapes, matcher, fixes));
  // Without known walls it can't say that there is no position.
  if (!walls_.empty()) words[1] = PoseFixData::encode(fixes);
}

/// Returns the matcher of a field's walls. It is kept: drawing the walls of a building takes as
/// long as some scans do.
const WallMatcher& LrfIconicExtractor::matcherOf(const FieldModel& field) {
  // Matching is limited by the scan's rounding, even without noise.
  constexpr double kFinest = 0.005;  // [m]
  const double sigma = settings_.rangeSigma + settings_.rangeSigmaPerMetre * 0.5 * maxRange_;
  const WallMatcherConfig config{.rangeSigma = std::max(kFinest, sigma),
                                 .wallSigma = settings_.wallSigma,
                                 .shareMatched = settings_.shareMatched,
                                 .mostFixes = settings_.mostFixes};
  std::vector<FieldWall> walls = wallsAt(field, settings_.mounting.z);
  const auto ends = [](const FieldWall& w) { return std::tie(w.x0, w.y0, w.x1, w.y1); };
  const bool isKnown =
      matcher_ && sigma_ == config.rangeSigma && std::ranges::equal(walls, walls_, {}, ends, ends);
  if (isKnown) return *matcher_;
  walls_ = std::move(walls);
  sigma_ = config.rangeSigma;
  matcher_ = std::make_unique<WallMatcher>(walls_, config);
  return *matcher_;
}

/// Returns, for each beam, whether it ends at a small body.
std::vector<std::uint8_t> LrfIconicExtractor::beamsOnCircles(const ScanShapes& shapes) const {
  constexpr double kSlack = 0.15;  // [m]: small bodies are not exact circles
  std::vector<std::uint8_t> beams(scan_.ranges.size(), 0);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const auto range = static_cast<double>(scan_.ranges[i]);
    if (!std::isfinite(range)) continue;
    const double angle = scan_.firstAngle + static_cast<double>(i) * scan_.angleStep;
    const PlanePoint end{range * std::cos(angle), range * std::sin(angle)};
    beams[i] = std::any_of(shapes.circles.begin(), shapes.circles.end(), [&](const ScanCircle& c) {
      return distance(c.middle, end) <= c.radius + kSlack;
    });
  }
  return beams;
}

/// Returns everything that is not a wall; without a position, everything.
ObstaclesData::Reading LrfIconicExtractor::obstacles(
    const ScanShapes& shapes, const WallMatcher& matcher,
    const std::vector<PoseFixData::Fix>& fixes) const {
  ObstaclesData::Reading list;
  const Pose2 scanner = inverse(settings_.mounting.pose) *
                        mount_;  // pose of the scanner in the frame of the obstacles
  const auto inOwn = [&](const PlanePoint& p) { return scanner * Pose2{p.x, p.y, 0.0}; };
  for (const ScanCircle& c : shapes.circles) {
    const Pose2 middle = inOwn(c.middle);
    list.push_back(
        {.shape = ObstaclesData::Shape::kCircle, .x = middle.x, .y = middle.y, .radius = c.radius});
  }
  for (const StraightPiece& s : shapes.segments) {
    const bool isWall = std::any_of(fixes.begin(), fixes.end(), [&](const PoseFixData::Fix& fix) {
      return matcher.isOfWall(s, mount_, fix.pose);
    });
    if (isWall) continue;
    const Pose2 from = inOwn(s.from);
    const Pose2 to = inOwn(s.to);
    list.push_back({.shape = ObstaclesData::Shape::kSegment,
                    .x = from.x,
                    .y = from.y,
                    .radius = 0.0,
                    .endX = to.x,
                    .endY = to.y});
  }
  if (list.size() > ObstaclesData::kMostObstacles) list.resize(ObstaclesData::kMostObstacles);
  return list;
}

}  // namespace ortung
