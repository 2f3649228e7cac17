#include "LandmarkPlaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ortung {
namespace {

/// Sightings farther than this from every landmark are of none [m]; it is enough for poses that are
/// only as exact as those of a search over the whole field.
constexpr double kReach = 3.0;
constexpr double kCell = 0.1;         // [m]; if two landmarks are equally near, either is right
constexpr double kMostCells = 4.0e6;  // if landmarks are far apart, cells are larger
constexpr double kFarthest = 1.0e6;   // [m]
constexpr double kMostLandmarks = 65535.0;

}  // namespace

void LandmarkPlaces::start(const FieldGrid& region, std::size_t landmarks) {
  *this = {};
  region_ = region;
  x_.assign(landmarks, 0.0);
  y_.assign(landmarks, 0.0);
  counts_.assign(landmarks, 0.0);
}

void LandmarkPlaces::mark(std::size_t index, double x, double y) {
  x_[index] += x;
  y_[index] += y;
  counts_[index] += 1.0;
}

void LandmarkPlaces::finish() {
  for (std::size_t i = 0; i < counts_.size(); ++i) {  // of landmarks never seen it is 0 / 0
    x_[i] /= counts_[i];
    y_[i] /= counts_[i];
  }
  counts_ = {};
  makeGrid();
}

void LandmarkPlaces::makeGrid() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double xLow = kFar;
  double yLow = kFar;
  double xHigh = -kFar;
  double yHigh = -kFar;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (std::isnan(x_[i])) continue;
    xLow = std::min(xLow, x_[i] - kReach);
    xHigh = std::max(xHigh, x_[i] + kReach);
    yLow = std::min(yLow, y_[i] - kReach);
    yHigh = std::max(yHigh, y_[i] + kReach);
  }
  nearest_.clear();
  if (!(xLow < xHigh)) return;  // no landmark was ever seen
  const double area = (xHigh - xLow) * (yHigh - yLow);
  grid_.cell = std::max(kCell, std::sqrt(area / kMostCells));
  grid_.originX = xLow;
  grid_.originY = yLow;
  grid_.columns = static_cast<int>(std::ceil((xHigh - xLow) / grid_.cell));
  grid_.rows = static_cast<int>(std::ceil((yHigh - yLow) / grid_.cell));
  nearest_.assign(grid_.size(), kNone);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (std::isnan(x_[i])) continue;
    const auto within = [&](double from, int most) {
      return std::clamp(static_cast<int>(std::floor(from / grid_.cell)), 0, most - 1);
    };
    const int left = within(x_[i] - kReach - xLow, grid_.columns);
    const int right = within(x_[i] + kReach - xLow, grid_.columns);
    const int bottom = within(y_[i] - kReach - yLow, grid_.rows);
    const int top = within(y_[i] + kReach - yLow, grid_.rows);
    for (int row = bottom; row <= top; ++row) {
      for (int column = left; column <= right; ++column) {
        const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) +
                          static_cast<std::size_t>(column);
        const double cx = grid_.centreX(cell);
        const double cy = grid_.centreY(cell);
        const double distance = std::hypot(x_[i] - cx, y_[i] - cy);
        const std::uint16_t other = nearest_[cell];
        if (distance < kReach &&
            (other == kNone || distance < std::hypot(x_[other] - cx, y_[other] - cy)))
          nearest_[cell] = static_cast<std::uint16_t>(i);
      }
    }
  }
}

void LandmarkPlaces::save(TableWriter& file, const std::string& prefix) const {
  std::vector<std::int32_t> numbers;
  std::vector<double> places;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (std::isnan(x_[i])) continue;
    numbers.push_back(static_cast<std::int32_t>(i));
    places.insert(places.end(), {x_[i], y_[i]});
  }
  file.add<std::int32_t>(prefix + "landmark_numbers", {numbers.size()}, numbers);
  file.add<double>(prefix + "landmark_places", {numbers.size(), 2}, places);
}

void LandmarkPlaces::load(const std::shared_ptr<const TableFile>& file, const std::string& prefix,
                          const FieldGrid& region, std::size_t landmarks) {
  const auto numbers = file->get<std::int32_t>(prefix + "landmark_numbers", {0});
  const auto places = file->get<double>(prefix + "landmark_places", {numbers.size(), 2});
  *this = {};
  region_ = region;
  x_.assign(landmarks, std::numeric_limits<double>::quiet_NaN());
  y_ = x_;
  std::int32_t last = -1;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double x = places[2 * i];
    const double y = places[2 * i + 1];
    const bool isRight = numbers[i] > last && static_cast<std::size_t>(numbers[i]) < landmarks &&
                         std::abs(x) < kFarthest && std::abs(y) < kFarthest;
    if (!isRight || static_cast<double>(landmarks) > kMostLandmarks) {
      throw TableError(file->path().string() + ": table " + prefix +
                       "landmark_places has impossible values");
    }
    last = numbers[i];
    x_[static_cast<std::size_t>(last)] = x;
    y_[static_cast<std::size_t>(last)] = y;
  }
  makeGrid();
}

}  // namespace ortung
