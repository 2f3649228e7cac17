#include "ortung/calibration/LineCalibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/vision/FloorSight.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostPoints = 150;  ///< greatest number of points that are used of a picture
constexpr double kAboveFloor = 0.02;      ///< margin above the floor's end [image heights]
constexpr double kNear = 5.0;             ///< range within which a fit is reported [m]
constexpr double kFar = 15.0;             ///< range up to which points are used [m]
constexpr double kMostCost = 9.0;

/// The parameters that are estimated. Lengths are their logarithms, which keeps them positive.
enum Setting { kFocal, kK1, kK2, kCentreU, kCentreV, kTilt, kRoll, kHeight, kSettings };
using Settings = Eigen::Matrix<double, kSettings, 1>;

CameraView viewOf(ImageSize size, const Settings& s) {
  Parameters p("camera");
  const double focal = std::exp(s[kFocal]);
  p.set("model", "fisheye");
  p.set("size_px", std::vector<double>{double(size.width), double(size.height)});
  p.set("focal_px", std::vector<double>{focal, focal});
  p.set("centre_px", std::vector<double>{s[kCentreU], s[kCentreV]});
  p.set("distortion", std::vector<double>{s[kK1], s[kK2], 0.0, 0.0});
  return {readCamera(p), {.z = std::exp(s[kHeight]), .tilt = s[kTilt], .roll = s[kRoll]}};
}

/// A hypothesis: settings of the camera, and the pose at which each picture was taken.
struct Solution {
  Settings settings;
  std::vector<Pose2> poses;
  double cost = 0.0;
};

class Calibrator {
 public:
  Calibrator(ImageSize size, std::span<const LinePicture> pictures, const LinePoseSearch& field,
             const LineCalibrationGuess& guess)
      : size_(size), field_(field), guess_(guess) {
    for (const LinePicture& picture : pictures) {
      std::vector<Pixel> onFloor;
      for (const LinePoint& point : picture.points)
        if (point.pixel.v >= picture.floorTop - kAboveFloor * size.height)
          onFloor.push_back(point.pixel);
      std::vector<Pixel> used;
      const std::size_t count = std::min(onFloor.size(), kMostPoints);
      for (std::size_t k = 0; k < count; ++k) used.push_back(onFloor[k * onFloor.size() / count]);
      pixels_.push_back(std::move(used));
      floorTop_ =
          pictures.data() == &picture ? picture.floorTop : std::min(floorTop_, picture.floorTop);
    }
    const double side = std::max(size.width, size.height);
    sigmas_ << guess.focalShare, 0.08, 0.05, guess.centreSigma * side, guess.centreSigma * side,
        guess.tiltSigma, guess.rollSigma, guess.heightShare;
  }

  /// Returns the settings with which a search begins. The horizon is a little above the row at
  /// which the floor ends.
  /// @param far how far away the floor ends [m]
  Settings start(double focalShare, double height, double far) const {
    const double side = std::max(size_.width, size_.height);
    const double focal = focalShare * side;
    Settings s = Settings::Zero();
    s[kFocal] = std::log(focal);
    s[kK1] = guess_.distortion[0];
    s[kK2] = guess_.distortion[1];
    s[kCentreU] = (size_.width - 1) / 2.0;
    s[kCentreV] = (size_.height - 1) / 2.0;
    s[kTilt] = guess_.tilt.value_or((s[kCentreV] - floorTop_) / focal + height / far);
    s[kHeight] = std::log(height);
    return s;
  }

  Solution search(const Settings& settings) const {
    Solution solution{settings, {}, 0.0};
    const CameraView view = viewOf(size_, settings);
    double sum = 0.0;
    std::size_t count = 0;
    for (const auto& pixels : pixels_) {
      std::vector<LinePlace> places;
      std::vector<double> sigmas;
      for (const Pixel& pixel : pixels) {
        const auto sight = floorSightOf(view, pixel, 2.0 * guess_.pixelSigma);
        if (!sight || std::hypot(sight->x, sight->y) > kFar) continue;
        places.push_back({sight->x, sight->y});
        sigmas.push_back(sight->sigma);
      }
      const std::vector<LinePose> best = field_.search(places, sigmas, 1);
      solution.poses.push_back(best.empty() ? Pose2{} : best[0].pose);
      // Points above the horizon show no floor: each has the greatest cost.
      const double lost = kMostCost * static_cast<double>(pixels.size() - places.size());
      sum += lost + (best.empty() ? 0.0 : best[0].cost * static_cast<double>(places.size()));
      count += pixels.size();
    }
    solution.cost = count > 0 ? sum / static_cast<double>(count) : 0.0;
    return solution;
  }

  /// Levenberg and Marquardt's steps on settings and poses together.
  void refine(Solution& solution, const Settings& prior, int steps) const {
    const auto n = static_cast<Eigen::Index>(kSettings + 3 * solution.poses.size());
    double damping = 1e-2;
    solution.cost = costOf(solution, prior);
    for (int step = 0; step < steps; ++step) {
      Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
      Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n);
      gather(solution, prior, information, gradient);
      bool isBetter = false;
      for (int attempt = 0; attempt < 8 && !isBetter; ++attempt) {
        Eigen::MatrixXd damped = information;
        damped.diagonal() *= 1.0 + damping;
        damped.diagonal().array() += 1e-9;
        const Eigen::VectorXd move = -damped.ldlt().solve(gradient);
        Solution next = moved(solution, move);
        next.cost = costOf(next, prior);
        isBetter = std::isfinite(next.cost) && next.cost < solution.cost;
        if (isBetter) {
          const bool isDone = solution.cost - next.cost < 1e-7;
          solution = std::move(next);
          damping = std::max(1e-6, damping * 0.3);
          if (isDone) return;
        } else {
          damping *= 5.0;
        }
      }
      if (!isBetter) return;
    }
  }

  LineCalibration result(const Solution& solution) const {
    LineCalibration out{viewOf(size_, solution.settings), solution.cost, {}};
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      LinePictureFit fit{solution.poses[i], 0, 0.0, 0.0};
      std::vector<double> near;
      std::size_t matched = 0;
      for (const Pixel& pixel : pixels_[i]) {
        const auto sight = floorSightOf(out.view, pixel, guess_.pixelSigma);
        if (!sight) continue;
        const Pose2 place = fit.pose * Pose2{sight->x, sight->y, 0.0};
        const double d = field_.nearest(place.x, place.y).distance;
        if (d < 3.0 * std::max(sight->sigma, 0.03)) ++matched;
        if (std::hypot(sight->x, sight->y) <= kNear) near.push_back(d);
      }
      fit.points = near.size();
      if (!near.empty()) {
        const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
        std::nth_element(near.begin(), middle, near.end());
        fit.median = *middle;
      }
      if (!pixels_[i].empty())
        fit.matchedShare = static_cast<double>(matched) / static_cast<double>(pixels_[i].size());
      out.pictures.push_back(fit);
    }
    return out;
  }

 private:
  /// A point and the nearest line.
  struct Match {
    Pixel pixel;
    double x, y;      ///< the point in the sensor's frame [m]
    double nx, ny;    ///< unit normal from the line to the point, in the field frame
    double distance;  ///< [m]
    double sigma;     ///< standard deviation of the distance [m]
  };

  template <typename What>
  void eachMatch(const CameraView& view, const Solution& solution, std::size_t i,
                 const What& what) const {
    const Pose2& pose = solution.poses[i];
    const double c = std::cos(pose.theta);
    const double s = std::sin(pose.theta);
    for (const Pixel& pixel : pixels_[i]) {
      const auto here = view.floorAt(pixel);
      const auto right = view.floorAt({pixel.u + 0.5, pixel.v});
      const auto below = view.floorAt({pixel.u, pixel.v + 0.5});
      if (!here || !right || !below || std::hypot(here->x, here->y) > 2.0 * kFar) {
        what(nullptr);
        continue;
      }
      const double x = pose.x + c * here->x - s * here->y;
      const double y = pose.y + s * here->x + c * here->y;
      const FieldLines::Nearest n = field_.nearest(x, y);
      Match m{pixel, here->x, here->y, 1.0, 0.0, n.distance, 0.0};
      if (n.distance > 1e-9) {
        m.nx = (x - n.x) / n.distance;
        m.ny = (y - n.y) / n.distance;
      }
      // The normal in the sensor's frame: only a pixel's error across the line counts.
      const double lx = c * m.nx + s * m.ny;
      const double ly = c * m.ny - s * m.nx;
      const double alongU = 2.0 * ((right->x - here->x) * lx + (right->y - here->y) * ly);
      const double alongV = 2.0 * ((below->x - here->x) * lx + (below->y - here->y) * ly);
      m.sigma = std::hypot(0.01, guess_.pixelSigma * std::hypot(alongU, alongV));
      what(&m);
    }
  }

  /// The loss of Geman and McClure: r^2 near 0, never more than kMostCost.
  static double robust(double r) { return r * r / (1.0 + r * r / kMostCost); }
  static double weight(double r) {
    const double d = 1.0 + r * r / kMostCost;
    return 1.0 / (d * d);
  }

  double costOf(const Solution& solution, const Settings& prior) const {
    const CameraView view = viewOf(size_, solution.settings);
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      eachMatch(view, solution, i, [&](const Match* m) {
        sum += m ? robust(m->distance / m->sigma) : kMostCost;
        ++count;
      });
    const Settings off = (solution.settings - prior).cwiseQuotient(sigmas_);
    return (sum + priorWeight() * off.squaredNorm()) /
           static_cast<double>(std::max<std::size_t>(1, count));
  }

  /// Errors of points on one line are correlated, so the prior counts as much as several of them.
  static double priorWeight() { return 5.0; }

  void gather(const Solution& solution, const Settings& prior, Eigen::MatrixXd& information,
              Eigen::VectorXd& gradient) const {
    const CameraView view = viewOf(size_, solution.settings);
    std::vector<CameraView> shifted;
    Settings shifts;
    shifts << 1e-4, 1e-4, 1e-4, 0.05, 0.05, 1e-4, 1e-4, 1e-4;
    for (int k = 0; k < kSettings; ++k) {
      Settings s = solution.settings;
      s[k] += shifts[k];
      shifted.push_back(viewOf(size_, s));
    }
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const Pose2& pose = solution.poses[i];
      const double c = std::cos(pose.theta);
      const double s = std::sin(pose.theta);
      const auto at = static_cast<Eigen::Index>(kSettings + 3 * i);
      eachMatch(view, solution, i, [&](const Match* m) {
        if (!m) return;
        Eigen::Matrix<double, kSettings + 3, 1> slope;
        for (int k = 0; k < kSettings; ++k) {
          const auto f = shifted[static_cast<std::size_t>(k)].floorAt(m->pixel);
          if (!f) return;
          const double dx = (f->x - m->x) / shifts[k];
          const double dy = (f->y - m->y) / shifts[k];
          slope[k] = m->nx * (c * dx - s * dy) + m->ny * (s * dx + c * dy);
        }
        slope[kSettings] = m->nx;
        slope[kSettings + 1] = m->ny;
        const double dx = c * m->x - s * m->y;
        const double dy = s * m->x + c * m->y;
        slope[kSettings + 2] = m->ny * dx - m->nx * dy;
        const double w = weight(m->distance / m->sigma) / (m->sigma * m->sigma);
        const auto own = slope.tail<3>();
        const auto common = slope.head<kSettings>();
        information.topLeftCorner<kSettings, kSettings>() += w * common * common.transpose();
        information.block<kSettings, 3>(0, at) += w * common * own.transpose();
        information.block<3, kSettings>(at, 0) += w * own * common.transpose();
        information.block<3, 3>(at, at) += w * own * own.transpose();
        gradient.head<kSettings>() += w * m->distance * common;
        gradient.segment<3>(at) += w * m->distance * own;
      });
    }
    for (int k = 0; k < kSettings; ++k) {
      const double w = priorWeight() / (sigmas_[k] * sigmas_[k]);
      information(k, k) += w;
      gradient[k] += w * (solution.settings[k] - prior[k]);
    }
  }

  static Solution moved(const Solution& solution, const Eigen::VectorXd& move) {
    Solution next = solution;
    next.settings += move.head<kSettings>();
    for (std::size_t i = 0; i < next.poses.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(kSettings + 3 * i);
      Pose2& p = next.poses[i];
      p = {p.x + move[at], p.y + move[at + 1], wrapAngle(p.theta + move[at + 2])};
    }
    return next;
  }

  ImageSize size_;
  const LinePoseSearch& field_;
  LineCalibrationGuess guess_;
  std::vector<std::vector<Pixel>> pixels_;  ///< pixels of each picture's points
  double floorTop_ = 0.0;                   ///< highest row at which a picture's floor ends [px]
  Settings sigmas_;                         ///< standard deviations of the prior
};

}  // namespace

std::optional<LineCalibration> calibrateByLines(ImageSize size,
                                                std::span<const LinePicture> pictures,
                                                const LinePoseSearch& field,
                                                const LineCalibrationGuess& guess,
                                                const std::function<void(double)>& progress) {
  if (std::all_of(pictures.begin(), pictures.end(),
                  [](const LinePicture& p) { return p.points.empty(); }))
    return std::nullopt;
  const Calibrator calibrator(size, pictures, field, guess);
  const std::array<double, 3> heights = {guess.height * std::exp(-guess.heightShare), guess.height,
                                         guess.height * std::exp(guess.heightShare)};
  std::vector<std::pair<Solution, Settings>> tries;
  double done = 0.0;
  constexpr std::array<double, 2> kFloorEnds = {8.0, 25.0};  // [m]
  constexpr std::size_t kRefined = 10;
  const double all =
      static_cast<double>(guess.focals.size() * heights.size() * kFloorEnds.size() + kRefined);
  const auto tell = [&] {
    if (progress) progress(std::min(1.0, ++done / all));
  };
  for (const double focal : guess.focals)
    for (const double height : heights)
      for (const double far : kFloorEnds) {
        const Settings start = calibrator.start(focal, height, far);
        Settings prior = start;
        prior[kHeight] = std::log(guess.height);
        tries.emplace_back(calibrator.search(start), prior);
        tell();
      }
  std::sort(tries.begin(), tries.end(),
            [](const auto& a, const auto& b) { return a.first.cost < b.first.cost; });
  tries.resize(std::min(tries.size(), kRefined));
  std::optional<Solution> best;
  for (auto& [solution, prior] : tries) {
    calibrator.refine(solution, prior, 30);
    Solution again = calibrator.search(solution.settings);
    calibrator.refine(again, prior, 40);
    if (again.cost < solution.cost) solution = std::move(again);
    if (!best || solution.cost < best->cost) best = std::move(solution);
    tell();
  }
  return calibrator.result(*best);
}

}  // namespace ortung
