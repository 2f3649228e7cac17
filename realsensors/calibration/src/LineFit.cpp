#include "LineFit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "ortung/base/Angles.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/vision/FloorSight.hpp"
#include "ortung/vision/LineErrors.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostPoints = 150;  ///< greatest number of points that are used of a picture
constexpr double kAboveFloor = 0.02;      ///< margin above the floor's end [image heights]
constexpr double kNear = 5.0;             ///< range within which a fit is reported [m]
constexpr double kFar = 15.0;             ///< range up to which points are used [m]
constexpr double kMostCost = 9.0;
/// Errors of points on one line are correlated, so the prior counts as much as several of them.
constexpr double kPriorWeight = 5.0;

constexpr double kLeastNoise = 0.09;  ///< least square of points' errors / their sigma

/// The loss of Geman and McClure: r^2 near 0, never more than kMostCost.
double robust(double r) { return r * r / (1.0 + r * r / kMostCost); }
double weight(double r) {
  const double d = 1.0 + r * r / kMostCost;
  return 1.0 / (d * d);
}
/// The slope of r * weight(r): half the loss's curvature.
double curvature(double r) {
  const double d = 1.0 + r * r / kMostCost;
  return (1.0 - 3.0 * r * r / kMostCost) / (d * d * d);
}

}  // namespace

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

LineFit::LineFit(ImageSize size, std::span<const LinePicture> pictures, const LinePoseSearch& field,
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
    tilts_.push_back(picture.tilt);
    floorTop_ =
        pictures.data() == &picture ? picture.floorTop : std::min(floorTop_, picture.floorTop);
  }
  const double side = std::max(size.width, size.height);
  sigmas_ << guess.focalShare, 0.08, 0.05, guess.centreSigma * side, guess.centreSigma * side,
      guess.tiltSigma, guess.rollSigma, guess.heightShare;
}

Settings LineFit::start(double focalShare, double height, double far) const {
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

LineSolution LineFit::search(const Settings& settings, const Settings& prior) const {
  LineSolution solution{settings, prior, {}, 0.0};
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Places places = placesOf(settings, i);
    const std::vector<LinePose> best = field_.search(places.points, places.sigmas, 1);
    solution.poses.push_back(best.empty() ? Pose2{} : best[0].pose);
    // Points above the horizon show no floor: each has the greatest cost.
    const double lost = kMostCost * static_cast<double>(pixels_[i].size() - places.points.size());
    sum += lost + (best.empty() ? 0.0 : best[0].cost * static_cast<double>(places.points.size()));
    count += pixels_[i].size();
  }
  solution.cost = count > 0 ? sum / static_cast<double>(count) : 0.0;
  return solution;
}

CameraView LineFit::viewOf(const Settings& settings, std::size_t picture) const {
  Settings its = settings;
  its[kTilt] += tilts_[picture];
  return ortung::viewOf(size_, its);
}

LineFit::Places LineFit::placesOf(const Settings& settings, std::size_t picture) const {
  Places places;
  const CameraView view = viewOf(settings, picture);
  for (const Pixel& pixel : pixels_[picture]) {
    const auto sight = floorSightOf(view, pixel, 2.0 * guess_.pixelSigma);
    if (!sight || std::hypot(sight->x, sight->y) > kFar) continue;
    places.points.push_back({sight->x, sight->y});
    places.sigmas.push_back(sight->sigma);
  }
  return places;
}

void LineFit::refine(LineSolution& solution, int steps) const {
  double damping = 1e-2;
  solution.cost = costOf(solution);
  for (int step = 0; step < steps; ++step) {
    const Normal normal = gather(solution);
    bool isBetter = false;
    for (int attempt = 0; attempt < 8 && !isBetter; ++attempt) {
      Eigen::MatrixXd damped = normal.information;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-9;
      const Eigen::VectorXd move = -damped.ldlt().solve(normal.gradient);
      LineSolution next = moved(solution, move);
      next.cost = costOf(next);
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

std::vector<LinePictureFit> LineFit::fits(const LineSolution& solution) const {
  std::vector<LinePictureFit> all;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const CameraView view = viewOf(solution.settings, i);
    LinePictureFit fit;
    fit.pose = solution.poses[i];
    std::vector<double> near;
    std::size_t matched = 0;
    for (const Pixel& pixel : pixels_[i]) {
      const auto sight = floorSightOf(view, pixel, guess_.pixelSigma);
      if (!sight) continue;
      const Pose2 place = fit.pose * Pose2{sight->x, sight->y, 0.0};
      const double d = field_.nearest(place.x, place.y).distance;
      const bool isMatched = d < 3.0 * std::max(sight->sigma, 0.03);
      if (isMatched) ++matched;
      if (std::hypot(sight->x, sight->y) > kNear) continue;
      near.push_back(d);
      if (!isMatched) ++fit.strayNear;
    }
    fit.points = near.size();
    if (!near.empty()) {
      const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
      std::nth_element(near.begin(), middle, near.end());
      fit.median = *middle;
    }
    if (!pixels_[i].empty())
      fit.matchedShare = static_cast<double>(matched) / static_cast<double>(pixels_[i].size());
    all.push_back(fit);
  }
  return all;
}

std::size_t LineFit::points() const {
  std::size_t count = 0;
  for (const auto& pixels : pixels_) count += pixels.size();
  return count;
}

template <typename What>
void LineFit::eachMatch(const LineSolution& solution, std::size_t i, const What& what) const {
  const CameraView view = viewOf(solution.settings, i);
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

double LineFit::costOf(const LineSolution& solution) const {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i)
    eachMatch(solution, i, [&](const Match* m) {
      sum += m ? robust(m->distance / m->sigma) : kMostCost;
      ++count;
    });
  const Settings off = (solution.settings - solution.prior).cwiseQuotient(sigmas_);
  return (sum + kPriorWeight * off.squaredNorm()) /
         static_cast<double>(std::max<std::size_t>(1, count));
}

/// Calls what(match, slope, picture) for each point whose distance has slopes.
template <typename What>
void LineFit::eachSlope(const LineSolution& solution, const What& what) const {
  Settings shifts;
  shifts << 1e-4, 1e-4, 1e-4, 0.05, 0.05, 1e-4, 1e-4, 1e-4;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    std::vector<CameraView> shifted;
    for (int k = 0; k < kSettings; ++k) {
      Settings moved = solution.settings;
      moved[k] += shifts[k];
      shifted.push_back(viewOf(moved, i));
    }
    const Pose2& pose = solution.poses[i];
    const double c = std::cos(pose.theta);
    const double s = std::sin(pose.theta);
    eachMatch(solution, i, [&](const Match* m) {
      if (!m) return;
      Slope slope;
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
      what(*m, slope, i);
    });
  }
}

namespace {

/// Adds factor * slope * slope' to the rows and columns of the settings and of one pose.
void addSquare(Eigen::MatrixXd& sum, const Eigen::Matrix<double, kSettings + 3, 1>& slope,
               Eigen::Index pose, double factor) {
  const auto own = slope.tail<3>();
  const auto common = slope.head<kSettings>();
  sum.topLeftCorner<kSettings, kSettings>() += factor * common * common.transpose();
  sum.block<kSettings, 3>(0, pose) += factor * common * own.transpose();
  sum.block<3, kSettings>(pose, 0) += factor * own * common.transpose();
  sum.block<3, 3>(pose, pose) += factor * own * own.transpose();
}

}  // namespace

LineFit::Normal LineFit::gather(const LineSolution& solution) const {
  const Eigen::Index n = unknowns();
  Normal normal{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  eachSlope(solution, [&](const Match& m, const Slope& slope, std::size_t i) {
    const double w = weight(m.distance / m.sigma) / (m.sigma * m.sigma);
    addSquare(normal.information, slope, poseAt(i), w);
    normal.gradient.head<kSettings>() += w * m.distance * slope.head<kSettings>();
    normal.gradient.segment<3>(poseAt(i)) += w * m.distance * slope.tail<3>();
  });
  for (int k = 0; k < kSettings; ++k) {
    const double w = kPriorWeight / (sigmas_[k] * sigmas_[k]);
    normal.information(k, k) += w;
    normal.gradient[k] += w * (solution.settings[k] - solution.prior[k]);
  }
  return normal;
}

LineSolution LineFit::moved(const LineSolution& solution, const Eigen::VectorXd& move) {
  LineSolution next = solution;
  next.settings += move.head<kSettings>();
  for (std::size_t i = 0; i < next.poses.size(); ++i) {
    Pose2& p = next.poses[i];
    const auto own = move.segment<3>(poseAt(i));
    p = {p.x + own[0], p.y + own[1], wrapAngle(p.theta + own[2])};
  }
  return next;
}

double LineFit::alikenessOf(const LineSolution& solution) const {
  std::vector<LineError> errors;
  for (std::size_t i = 0; i < pixels_.size(); ++i)
    eachMatch(solution, i, [&](const Match* m) {
      if (!m) return;
      const Pose2 place = solution.poses[i] * Pose2{m->x, m->y, 0.0};
      errors.push_back({i, {place.x, place.y}, m->distance / m->sigma});
    });
  return alikeness(field_.lines(), errors);
}

// The settings are where the slope of the cost is 0. Noise of the points and what the camera
// differs from the expected one move that place by the inverse of the cost's curvature (Huber's
// sandwich). The noise is what the points show, with what neighbours on a line have in common.
LineFit::Certainty LineFit::certainty(const LineSolution& solution) const {
  const Eigen::Index n = unknowns();
  Eigen::MatrixXd curved = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(n, n);
  // Few points are fitted well by chance: that does not make them exact.
  const double all = static_cast<double>(points());
  const double least = std::clamp(static_cast<double>(n) / std::max(1.0, all), kLeastNoise, 1.0);
  double weights = 0.0;
  double curvatures = 0.0;
  eachSlope(solution, [&](const Match& m, const Slope& slope, std::size_t i) {
    const double r = m.distance / m.sigma;
    const double w = weight(r);
    weights += w;
    curvatures += curvature(r);
    addSquare(curved, slope, poseAt(i), w / (m.sigma * m.sigma));
    addSquare(noise, slope, poseAt(i), w * w * std::max(r * r, least) / (m.sigma * m.sigma));
  });
  const double alike = alikenessOf(solution);
  curved *= std::clamp(curvatures / std::max(weights, 1e-9), 0.3, 1.0);
  noise *= alike;
  // Fits of few points have less noise than the points: as many parameters were fitted to it.
  noise *= all / std::max(0.25 * all, all - static_cast<double>(n));
  // A pose of which the points say nothing is somewhere on the field.
  constexpr std::array<double, 3> kAnywhere = {10.0, 10.0, 3.0};  // [m], [m], [rad]
  for (Eigen::Index k = 0; k < n; ++k) {
    const double sigma =
        k < kSettings ? sigmas_[k] : kAnywhere[static_cast<std::size_t>(k - kSettings) % 3];
    const double w = (k < kSettings ? kPriorWeight : 1.0) / (sigma * sigma);
    curved(k, k) += w;
    noise(k, k) += w * w * sigma * sigma;
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(curved);
  const Eigen::MatrixXd half = solver.solve(noise);
  const Eigen::MatrixXd covariance = solver.solve(half.transpose());
  const SettingsCovariance own = covariance.topLeftCorner<kSettings, kSettings>();
  return {0.5 * (own + own.transpose()), all / alike};
}

}  // namespace ortung
