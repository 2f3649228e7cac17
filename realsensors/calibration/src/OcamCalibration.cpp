#include "OcamCalibration.hpp"

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <span>
#include <stdexcept>

namespace ortung {
namespace {

constexpr std::array<int, 4> kPowers = {0, 2, 3, 4};  // a slope at the centre would be a kink

/// A board's rotation and its place without the depth, which depends on the lens.
struct Seen {
  cv::Vec3d first, second;  ///< the first two columns of the rotation
  double x = 0.0, y = 0.0;
};

/// Returns corners relative to the centre, in half diagonals of the image.
std::vector<cv::Point2d> centred(const Corners& corners, const cv::Point2d& centre, double unit) {
  std::vector<cv::Point2d> out;
  for (const cv::Point2f& corner : corners)
    out.emplace_back((corner.x - centre.x) / unit, (corner.y - centre.y) / unit);
  return out;
}

/// Solves for what the direction from the centre determines alone: a point is seen in the direction
/// in which it lies from the optical axis.
/// @returns the pose up to the sign of the components along the axis
Seen radial(const Board& board, const std::vector<cv::Point2d>& seen) {
  cv::Mat_<double> rows(static_cast<int>(board.size()), 6);
  for (int i = 0; i < rows.rows; ++i) {
    const cv::Point3f& p = board[static_cast<std::size_t>(i)];
    const cv::Point2d& s = seen[static_cast<std::size_t>(i)];
    const double row[] = {-s.y * p.x, -s.y * p.y, s.x * p.x, s.x * p.y, -s.y, s.x};
    std::copy(row, row + 6, rows[i]);
  }
  cv::Mat h;
  cv::SVD::solveZ(rows, h);
  const auto at = [&](int i) { return h.at<double>(i); };
  double towards = 0.0;
  for (std::size_t i = 0; i < board.size(); ++i)
    towards += seen[i].x * (at(0) * board[i].x + at(1) * board[i].y + at(4)) +
               seen[i].y * (at(2) * board[i].x + at(3) * board[i].y + at(5));
  const double c = -(at(0) * at(1) + at(2) * at(3));
  const double d = at(0) * at(0) + at(2) * at(2) - at(1) * at(1) - at(3) * at(3);
  const double second = std::sqrt(std::max(0.0, (d + std::hypot(d, 2.0 * c)) / 2.0));
  const double first = second > 1e-9 ? c / second : std::sqrt(std::max(0.0, -d));
  Seen out{{at(0), at(2), first}, {at(1), at(3), second}, at(4), at(5)};
  const double scale = (towards < 0.0 ? -1.0 : 1.0) / cv::norm(out.first);
  out.first *= scale;
  out.second *= scale;
  out.x *= scale;
  out.y *= scale;
  return out;
}

/// Solves for the lens's coefficients of the given powers, and for the depth of each board.
cv::Mat solveLens(const Board& board, const std::vector<std::vector<cv::Point2d>>& corners,
                  std::span<const Seen> seen, std::size_t powers) {
  const int unknown = static_cast<int>(powers + corners.size());
  cv::Mat_<double> rows(static_cast<int>(2 * board.size() * corners.size()), unknown, 0.0);
  cv::Mat_<double> right(rows.rows, 1);
  int at = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (std::size_t i = 0; i < board.size(); ++i) {
      const Seen& s = seen[k];
      const cv::Point2d& p = corners[k][i];
      const double rho = std::hypot(p.x, p.y);
      const double along = s.first[2] * board[i].x + s.second[2] * board[i].y;
      const double sides[] = {s.first[1] * board[i].x + s.second[1] * board[i].y + s.y,
                              s.first[0] * board[i].x + s.second[0] * board[i].y + s.x};
      const double places[] = {p.y, p.x};
      for (int e = 0; e < 2; ++e, ++at) {
        for (std::size_t n = 0; n < powers; ++n)
          rows(at, static_cast<int>(n)) = sides[e] * std::pow(rho, kPowers[n]);
        rows(at, static_cast<int>(powers + k)) = -places[e];
        right(at) = places[e] * along;
      }
    }
  cv::Mat solution;
  cv::solve(rows, right, solution, cv::DECOMP_SVD);
  return solution;
}

/// Chooses the sign for which the board lies in front of the camera, not behind it.
void chooseSide(const Board& board, const std::vector<cv::Point2d>& corners, Seen& seen) {
  const cv::Mat lens = solveLens(board, {corners}, {&seen, 1}, 2);
  if (lens.at<double>(0) >= 0.0) return;
  seen.first[2] = -seen.first[2];
  seen.second[2] = -seen.second[2];
}

/// Makes the lens that has this centre and a coefficient for each power.
/// @param unit half the image's diagonal [px]
Lens lensOf(std::span<const double> numbers, double unit) {
  return [all = std::vector<double>(numbers.begin(), numbers.end()), unit](
             const cv::Vec3d& p, const cv::Point2d& near) {
    const double side = std::hypot(p[0], p[1]);
    if (!(side > 0.0)) return std::optional(cv::Point2d(all[0], all[1]));
    double rho = std::hypot(near.x - all[0], near.y - all[1]) / unit;
    for (int n = 0; n < 12; ++n) {
      double f = 0.0;
      double df = 0.0;
      for (std::size_t m = 0; m < kPowers.size(); ++m) {
        f += all[2 + m] * std::pow(rho, kPowers[m]);
        if (kPowers[m] > 0) df += all[2 + m] * kPowers[m] * std::pow(rho, kPowers[m] - 1);
      }
      rho -= (f * side - rho * p[2]) / (df * side - p[2]);
    }
    const double scale = unit * rho / side;
    return std::optional(cv::Point2d(all[0] + scale * p[0], all[1] + scale * p[1]));
  };
}

}  // namespace

OcamSolution solveOcam(const cv::Size& size, const Board& board,
                       const std::vector<Corners>& corners) {
  const double unit = 0.5 * std::hypot(size.width, size.height);
  const cv::Point2d centre(0.5 * (size.width - 1), 0.5 * (size.height - 1));
  std::vector<std::vector<cv::Point2d>> seenCorners;
  std::vector<Seen> seen;
  for (const Corners& one : corners) {
    seenCorners.push_back(centred(one, centre, unit));
    seen.push_back(radial(board, seenCorners.back()));
    chooseSide(board, seenCorners.back(), seen.back());
  }
  const cv::Mat lens = solveLens(board, seenCorners, seen, kPowers.size());
  BoardFit fit{{centre.x, centre.y}, {}, {}};
  for (int m = 0; m < 4; ++m) fit.lens.push_back(lens.at<double>(m));
  for (std::size_t k = 0; k < corners.size(); ++k) {
    cv::Matx33d turn;
    const cv::Vec3d third = seen[k].first.cross(seen[k].second);
    for (int i = 0; i < 3; ++i) {
      turn(i, 0) = seen[k].first[i];
      turn(i, 1) = seen[k].second[i];
      turn(i, 2) = third[i];
    }
    cv::Vec3d rotation;
    cv::Rodrigues(turn, rotation);
    fit.rotations.push_back(rotation);
    fit.translations.emplace_back(seen[k].x, seen[k].y, lens.at<double>(4 + static_cast<int>(k)));
  }
  refine(board, corners, [unit](std::span<const double> all) { return lensOf(all, unit); }, fit);
  OcamSolution found;
  found.centre = {fit.lens[0], fit.lens[1]};
  found.polynomial = {unit * fit.lens[2], 0.0, fit.lens[3] / unit, fit.lens[4] / (unit * unit),
                      fit.lens[5] / (unit * unit * unit)};
  for (const double number : found.polynomial)
    if (!std::isfinite(number)) throw std::runtime_error("these boards do not determine the model");
  if (!(found.polynomial[0] > 0.0))
    throw std::runtime_error(
        "these boards do not determine the model: none lies in front of the camera");
  found.rotations = std::move(fit.rotations);
  found.translations = std::move(fit.translations);
  return found;
}

}  // namespace ortung
