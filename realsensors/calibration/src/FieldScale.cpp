#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ortung/calibration/StandCalibration.hpp"

namespace ortung {
namespace {

/// Places as the columns of a matrix; each may be turned to the other half of the field.
Eigen::Matrix2Xd columnsOf(std::span<const LinePlace> places) {
  Eigen::Matrix2Xd columns(2, static_cast<Eigen::Index>(places.size()));
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    const LinePlace& place = places[static_cast<std::size_t>(i)];
    columns.col(i) << place.x, place.y;
  }
  return columns;
}

}  // namespace

std::optional<FieldScale> scaleOf(std::span<const LinePlace> found,
                                  std::span<const LinePlace> known) {
  constexpr std::size_t kLeast = 3;
  constexpr double kSame = 0.1;  // places closer together than this say nothing [m]
  if (found.size() != known.size() || found.size() < kLeast) return std::nullopt;
  const Eigen::Matrix2Xd to = columnsOf(known);
  Eigen::Matrix2Xd from = columnsOf(found);
  for (Eigen::Index i = 0; i < from.cols(); ++i)
    if (from.col(i).dot(to.col(i)) < 0.0) from.col(i) = -from.col(i);
  const Eigen::Vector2d middle = from.rowwise().mean();
  const double spread = (from.colwise() - middle).squaredNorm();
  if (!(spread > kSame * kSame)) return std::nullopt;
  const Eigen::Matrix3d similarity = Eigen::umeyama(from, to, true);
  FieldScale scale;
  scale.scale = similarity.topLeftCorner<2, 2>().col(0).norm();
  const Eigen::Matrix2Xd moved = similarity.topLeftCorner<2, 2>() * from;
  const double squares = ((moved.colwise() + similarity.topRightCorner<2, 1>()) - to).squaredNorm();
  const auto count = static_cast<double>(from.cols());
  scale.rootMeanSquare = std::sqrt(squares / count);
  // Four numbers of the similarity were fitted to two of each place.
  scale.sigma = std::sqrt(squares / std::max(1.0, 2.0 * count - 4.0) / spread);
  return scale;
}

}  // namespace ortung
