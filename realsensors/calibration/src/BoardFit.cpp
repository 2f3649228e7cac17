#include "BoardFit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

namespace ortung {
namespace {

constexpr int kPose = 6;
constexpr int kMostRounds = 300;
constexpr double kNoChange = 1e-9;  ///< relative decrease below which an iteration is idle
constexpr int kIdleRounds = 4;      ///< consecutive idle iterations that end the refinement
constexpr double kLeastDamping = 1e-12;
constexpr double kMostDamping = 1e12;
constexpr double kUnseen = std::numeric_limits<double>::infinity();

using Pose = Eigen::Matrix<double, kPose, 1>;

Pose poseOf(const BoardFit& fit, std::size_t k) {
  const cv::Vec3d& r = fit.rotations[k];
  const cv::Vec3d& t = fit.translations[k];
  return (Pose() << r[0], r[1], r[2], t[0], t[1], t[2]).finished();
}

/// Blocks of the normal equations that belong to one board, for small changes of the lens (L
/// parameters) and of the board's pose.
struct BoardEquations {
  Eigen::MatrixXd mixed;  ///< block of lens and pose, L x 6
  Eigen::Matrix<double, kPose, kPose> own;
  Pose right;
};

/// Normal equations. The poses of two boards share no residual: only the lens couples them.
struct Equations {
  Eigen::MatrixXd lens;  ///< block of the lens, L x L
  Eigen::VectorXd right;
  std::vector<BoardEquations> boards;
};

/// Reprojection errors of the corners, and their derivatives.
class Reprojection {
 public:
  Reprojection(const Board& board, const std::vector<Corners>& corners, const LensOf& lensOf)
      : board_(board), corners_(corners), lensOf_(lensOf) {}

  double sumOfSquares(const BoardFit& fit) const {
    const Lens lens = lensOf_(fit.lens);
    double sum = 0.0;
    for (std::size_t k = 0; k < corners_.size(); ++k)
      sum += errors(lens, poseOf(fit, k), k).squaredNorm();
    return sum;
  }

  Equations linearize(const BoardFit& fit) const {
    const auto count = static_cast<Eigen::Index>(fit.lens.size());
    const Lens lens = lensOf_(fit.lens);
    std::vector<Lens> up, down;  // with one number changed
    std::vector<double> steps;
    for (std::size_t p = 0; p < fit.lens.size(); ++p) {
      std::vector<double> other = fit.lens;
      steps.push_back(stepOf(other[p]));
      other[p] += steps[p];
      up.push_back(lensOf_(other));
      other[p] -= 2.0 * steps[p];
      down.push_back(lensOf_(other));
    }
    Equations all{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count), {}};
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Pose pose = poseOf(fit, k);
      const Eigen::VectorXd e = errors(lens, pose, k);
      Eigen::MatrixXd byLens(e.size(), count);
      for (std::size_t p = 0; p < fit.lens.size(); ++p)
        byLens.col(static_cast<Eigen::Index>(p)) =
            slope(errors(up[p], pose, k), errors(down[p], pose, k), steps[p]);
      Eigen::Matrix<double, Eigen::Dynamic, kPose> byPose(e.size(), kPose);
      for (int i = 0; i < kPose; ++i) {
        const Pose step = Pose::Unit(i) * stepOf(pose[i]);
        byPose.col(i) = slope(errors(lens, pose + step, k), errors(lens, pose - step, k), step[i]);
      }
      all.lens += byLens.transpose() * byLens;
      all.right -= byLens.transpose() * e;
      all.boards.push_back(
          {byLens.transpose() * byPose, byPose.transpose() * byPose, -byPose.transpose() * e});
    }
    return all;
  }

 private:
  static double stepOf(double number) { return 1e-5 * std::max(1.0, std::abs(number)); }

  /// A corner that leaves the field of view within the step has no slope: 0.
  static Eigen::VectorXd slope(const Eigen::VectorXd& up, const Eigen::VectorXd& down,
                               double step) {
    const Eigen::VectorXd out = (up - down) / (2.0 * step);
    return out.array().isFinite().select(out, 0.0);
  }

  Eigen::VectorXd errors(const Lens& lens, const Pose& pose, std::size_t k) const {
    cv::Matx33d turn;
    cv::Rodrigues(cv::Vec3d(pose[0], pose[1], pose[2]), turn);
    const cv::Vec3d place(pose[3], pose[4], pose[5]);
    Eigen::VectorXd out(static_cast<Eigen::Index>(2 * board_.size()));
    Eigen::Index at = 0;
    for (std::size_t i = 0; i < board_.size(); ++i) {
      const cv::Point2f& corner = corners_[k][i];
      const auto seen = lens(turn * cv::Vec3d(board_[i].x, board_[i].y, 0.0) + place, corner);
      out[at++] = seen ? seen->x - corner.x : kUnseen;
      out[at++] = seen ? seen->y - corner.y : kUnseen;
    }
    return out;
  }

  const Board& board_;
  const std::vector<Corners>& corners_;
  const LensOf& lensOf_;
};

/// Returns the fit after a step. Poses are eliminated first (Schur complement), which leaves
/// equations of the lens alone.
BoardFit stepped(const BoardFit& fit, const Equations& equations, double damping) {
  const double more = 1.0 + damping;
  Eigen::MatrixXd lens = equations.lens;
  lens.diagonal() *= more;
  Eigen::VectorXd right = equations.right;
  std::vector<Eigen::LDLT<Eigen::Matrix<double, kPose, kPose>>> own;
  for (const BoardEquations& board : equations.boards) {
    Eigen::Matrix<double, kPose, kPose> damped = board.own;
    damped.diagonal() *= more;
    own.emplace_back(damped);
    lens -= board.mixed * own.back().solve(board.mixed.transpose());
    right -= board.mixed * own.back().solve(board.right);
  }
  const Eigen::VectorXd change = lens.ldlt().solve(right);
  BoardFit next = fit;
  for (std::size_t p = 0; p < next.lens.size(); ++p)
    next.lens[p] += change[static_cast<Eigen::Index>(p)];
  for (std::size_t k = 0; k < own.size(); ++k) {
    const BoardEquations& board = equations.boards[k];
    const Pose move = own[k].solve(board.right - board.mixed.transpose() * change);
    next.rotations[k] += cv::Vec3d(move[0], move[1], move[2]);
    next.translations[k] += cv::Vec3d(move[3], move[4], move[5]);
  }
  return next;
}

}  // namespace

void refine(const Board& board, const std::vector<Corners>& corners, const LensOf& lensOf,
            BoardFit& fit) {
  const Reprojection reprojection(board, corners, lensOf);
  double sum = reprojection.sumOfSquares(fit);
  if (!std::isfinite(sum)) return;
  double damping = 1e-3;
  int idle = 0;
  for (int round = 0; round < kMostRounds && idle < kIdleRounds; ++round) {
    const Equations equations = reprojection.linearize(fit);
    BoardFit next = stepped(fit, equations, damping);
    double nextSum = reprojection.sumOfSquares(next);
    while (!(nextSum < sum) && damping < kMostDamping) {
      damping *= 10.0;
      next = stepped(fit, equations, damping);
      nextSum = reprojection.sumOfSquares(next);
    }
    if (!(nextSum < sum)) return;
    idle = sum - nextSum > kNoChange * sum ? 0 : idle + 1;
    fit = std::move(next);
    sum = nextSum;
    damping = std::max(0.1 * damping, kLeastDamping);
  }
}

}  // namespace ortung
