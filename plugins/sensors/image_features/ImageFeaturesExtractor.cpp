#include "ImageFeaturesExtractor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ortung/base/Angles.hpp"
#include "ortung/formats/ObjectsData.hpp"
#include "ortung/vision/FloorSight.hpp"

namespace ortung {
namespace {

/// Number of pictures between two estimates of the floor's colour: light changes slowly.
constexpr int kPicturesAColour = 10;

}  // namespace

ImageFeaturesExtractor::ImageFeaturesExtractor(const Parameters& p)
    : settings_(readImageFeaturesSettings(p)), finder_(settings_.finder) {
  if (!settings_.findsColours) colours_ = std::make_unique<ColourTable>(settings_.colours);
  for (const ColourRange& range : settings_.goalColours)
    goalColours_.push_back(
        std::make_unique<ColourTable>(Colours{.floor = {}, .ball = range, .paleBall = {}}));
  for (const ColourRange& range : settings_.postColours)
    postColours_.push_back(
        std::make_unique<ColourTable>(Colours{.floor = {}, .ball = range, .paleBall = {}}));
}

void ImageFeaturesExtractor::take(std::span<const SensorData* const> inputs) {
  // A calibration is more than parameters of a format can tell: it is asked of the class.
  const auto* image = dynamic_cast<const ImageData*>(inputs[0]);
  if (image == nullptr)
    throw std::invalid_argument(toText(inputs[0]->id()) + " is not a picture, expected one");
  if (!image->camera())
    throw std::invalid_argument(toText(image->id()) +
                                " has no calibration: its sensor has no table `camera`");
  const ImageView view = image->reading();
  if (view.format != PixelFormat::kRgb)
    throw std::invalid_argument(toText(image->id()) + " is grey, expected colours");
  size_ = view.size;
  format_ = view.format;
  pixels_.assign(view.pixels, view.pixels + view.bytes());
  view_ = image->camera();
  mount_ = image->mount();
}

void ImageFeaturesExtractor::prepare() {
  if (prepared_ == &view_->model()) return;
  prepared_ = &view_->model();
  if (settings_.sees("ball"))
    balls_ = std::make_unique<BallFinder>(
        *view_, BallFinder::Config{.radius = settings_.ballRadius, .maxRange = settings_.maxRange});
  if (settings_.sees("obstacles"))
    floor_ = std::make_unique<FloorScan>(
        *view_, FloorScan::Config{.maxRange = std::min(settings_.maxRange, 6.0)});
}

void ImageFeaturesExtractor::extract(const FieldModel&, std::span<std::optional<Words>> words) {
  if (!view_) return;
  prepare();
  const ImageView image{size_, format_, pixels_.data()};
  if (settings_.findsColours && untilColours_-- <= 0) {
    colours_ = std::make_unique<ColourTable>(findColours({&image, 1}));
    untilColours_ = kPicturesAColour - 1;
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& what = settings_.see[i];
    if (what == "lines")
      words[i] = lines(image);
    else if (what == "ball")
      words[i] = balls(image);
    else if (what == "obstacles")
      words[i] = obstacles(image);
    else if (what == "goals")
      words[i] = goals(image);
    else
      words[i] = posts(image);
  }
}

PointsData::Point ImageFeaturesExtractor::fromRobot(double x, double y) const {
  const Pose2 place = mount_ * Pose2{x, y, 0.0};
  return {std::hypot(place.x, place.y), std::atan2(place.y, place.x)};
}

/// Finds line points, one in each square of the floor, so that near points do not outnumber far
/// ones.
ImageFeaturesExtractor::Words ImageFeaturesExtractor::lines(const ImageView& image) {
  const double reach = settings_.lines.maxRange;
  const int side = static_cast<int>(2.0 * reach / settings_.spacing) + 2;
  taken_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
  std::vector<PointsData::Point> points;
  for (const LinePoint& found : finder_.find(image, *colours_)) {
    const auto sight = floorSightOf(*view_, found.pixel, settings_.pixelSigma);
    if (!sight || std::hypot(sight->x, sight->y) > reach) continue;
    const int column = static_cast<int>((sight->x + reach) / settings_.spacing);
    const int row = static_cast<int>((sight->y + reach) / settings_.spacing);
    std::uint8_t& square = taken_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
                                  static_cast<std::size_t>(column)];
    if (square != 0 || points.size() >= PointsData::kMostPoints) continue;
    square = 1;
    points.push_back(fromRobot(sight->x, sight->y));
  }
  return PointsData::encode(points);
}

ImageFeaturesExtractor::Words ImageFeaturesExtractor::balls(const ImageView& image) {
  std::vector<ObjectsData::Object> objects;
  for (const SeenBall& ball : balls_->find(image, *colours_)) {
    const auto from =
        fromRobot(ball.range * std::cos(ball.bearing), ball.range * std::sin(ball.bearing));
    objects.push_back({0, ObjectsData::kNoColour, from.range, from.bearing, settings_.ballRadius});
  }
  return ObjectsData::encode(objects);
}

ImageFeaturesExtractor::Words ImageFeaturesExtractor::obstacles(const ImageView& image) const {
  std::vector<ObjectsData::Object> objects;
  for (const FloorBody& body : floor_->find(image, *colours_)) {
    const double radius = 0.5 * body.width;
    const double range = body.range + radius;  // range of its middle
    const auto from = fromRobot(range * std::cos(body.bearing), range * std::sin(body.bearing));
    objects.push_back({0, ObjectsData::kNoColour, from.range, from.bearing, radius});
  }
  return ObjectsData::encode(objects);
}

/// Returns the point where a blob meets the floor, in the sensor frame: of its pixels in about the
/// direction of its middle, the one that shows the nearest floor. Nothing if none shows floor.
std::optional<Point3> ImageFeaturesExtractor::footOf(const ImageView& image,
                                                     const ColourTable& colours,
                                                     const Blob& blob) const {
  const auto middle = view_->rayAt(blob.middle);
  if (!middle) return std::nullopt;
  const double bearing = std::atan2(middle->y, middle->x);
  constexpr double kAside = 0.06;  // [rad]
  std::optional<Point3> foot;
  double nearest = settings_.maxRange;
  const int step = std::max(1, static_cast<int>(std::sqrt(blob.pixels) / 40.0));
  for (int v = static_cast<int>(blob.vMin); v < static_cast<int>(blob.vMax); v += step)
    for (int u = static_cast<int>(blob.uMin); u < static_cast<int>(blob.uMax); u += step) {
      const std::size_t at =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(image.size.width) +
          static_cast<std::size_t>(u);
      if (!colours.isBall(image.pixels + 3 * at)) continue;
      const auto floor = view_->floorAt({static_cast<double>(u), static_cast<double>(v)});
      if (!floor || std::abs(wrapAngle(std::atan2(floor->y, floor->x) - bearing)) > kAside)
        continue;
      const double range = std::hypot(floor->x, floor->y);
      if (range >= nearest) continue;
      nearest = range;
      foot = floor;
    }
  return foot;
}

/// Finds the largest blob of each goal's colour, and its place on the floor.
ImageFeaturesExtractor::Words ImageFeaturesExtractor::goals(const ImageView& image) const {
  LandmarksData::Reading seen;
  for (std::size_t i = 0; i < goalColours_.size(); ++i) {
    constexpr double kLeastPixels = 60.0;
    const auto blobs = findBlobs(image, *goalColours_[i], ColourClass::kBall, kLeastPixels);
    if (blobs.empty()) continue;
    const auto foot = footOf(image, *goalColours_[i], blobs.front());
    if (!foot) continue;
    // The bearing is that of the whole blob; the range is the wall's, less its distance behind the
    // goal line.
    const auto middle = view_->rayAt(blobs.front().middle);
    const double bearing = std::atan2(middle->y, middle->x);
    const double range = std::max(0.0, std::hypot(foot->x, foot->y) - settings_.goalDepth);
    const auto from = fromRobot(range * std::cos(bearing), range * std::sin(bearing));
    seen.push_back({settings_.goals.identities[i], from.range, from.bearing});
  }
  return LandmarksData::encode(seen);
}

/// Finds blobs of the posts' colours that are as narrow as posts at their distance.
ImageFeaturesExtractor::Words ImageFeaturesExtractor::posts(const ImageView& image) const {
  std::vector<PointsData::Point> seen;
  constexpr double kLeastPixels = 12.0;
  for (const auto& colours : postColours_)
    for (const Blob& blob : findBlobs(image, *colours, ColourClass::kBall, kLeastPixels)) {
      const auto foot = footOf(image, *colours, blob);
      const auto middle = view_->rayAt(blob.middle);
      if (!foot || !middle || seen.size() >= PointsData::kMostPoints) continue;
      const double range = std::hypot(foot->x, foot->y);
      const double bearing = std::atan2(middle->y, middle->x);
      // The greatest width of a post at this place, across its direction.
      const auto left =
          view_->pixelOf({foot->x - 0.5 * settings_.mostPostWidth * std::sin(bearing),
                          foot->y + 0.5 * settings_.mostPostWidth * std::cos(bearing), 0.0});
      const auto at = view_->pixelOf({foot->x, foot->y, 0.0});
      if (!left || !at) continue;
      const double mostWidth = 2.0 * std::hypot(left->u - at->u, left->v - at->v);
      // Posts have any direction in a mirror's picture: their mean width is their area by their
      // length.
      if (blob.pixels > mostWidth * std::hypot(blob.uMax - blob.uMin, blob.vMax - blob.vMin))
        continue;
      seen.push_back(fromRobot(range * std::cos(bearing), range * std::sin(bearing)));
    }
  return PointsData::encode(seen);
}

}  // namespace ortung
