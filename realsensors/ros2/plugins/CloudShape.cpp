#include "CloudShape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "FrameTree.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::ros2 {
namespace {

constexpr std::size_t kBlock = 512;  // points, whose quantities stay in the nearest cache
constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kFarthest = 1e6F;                // [m]; what is beyond is no place
constexpr float kThickness = 0.1F;               // of the nearest surface [m]
constexpr float kSlant = 1.75F;                  // tangent of 60 degrees
constexpr float kMostOfSlant = 0.3F;             // [m], so that wide beams do not reach behind
constexpr double kHighest = 100.0;               // [m]
constexpr double kLeast = 0.01, kMost = 1000.0;  // of ranges [m]

void checkNumber(const char* what, double value, double least, double most) {
  if (value >= least && value <= most) return;
  throw std::invalid_argument(std::string(what) + " is " + std::to_string(value) +
                              ", must be in [" + std::to_string(least) + ", " +
                              std::to_string(most) + "]");
}

/// A rotation and a translation.
struct Placing {
  std::array<float, 9> turn{};  ///< row-major
  std::array<float, 3> shift{};
};

Placing placingOf(const Eigen::Matrix3d& tilt, const Eigen::Isometry3d& mount) {
  const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> turn = (tilt * mount.linear()).cast<float>();
  const Eigen::Vector3f shift = (tilt * mount.translation()).cast<float>();
  Placing placing;
  std::copy_n(turn.data(), 9, placing.turn.begin());
  std::copy_n(shift.data(), 3, placing.shift.begin());
  return placing;
}

/// Returns how a placing changes in a second, if it becomes another one within some.
Placing changeOf(const Placing& from, const Placing& to, float seconds) {
  Placing change;
  for (std::size_t i = 0; i < change.turn.size(); ++i)
    change.turn[i] = (to.turn[i] - from.turn[i]) / seconds;
  for (std::size_t i = 0; i < change.shift.size(); ++i)
    change.shift[i] = (to.shift[i] - from.shift[i]) / seconds;
  return change;
}

/// What a point must be like to count.
struct Limits {
  float originX, originY;      ///< of the scanner [m]
  float eye;                   ///< height of the lidar [m]
  float minHeight, maxHeight;  ///< [m]
  float minRange, maxRange;    ///< [m]
  float beams, beamsPerRadian;
};

}  // namespace

struct CloudShape::Block {
  using Row = std::array<float, kBlock>;
  alignas(64) Row x, y, z;                            ///< [m]
  alignas(64) Row late;                               ///< after the stamp [s]
  alignas(64) Row range;                              ///< in the plane [m]; 0: does not count
  alignas(64) std::array<std::int32_t, kBlock> beam;  ///< in [0, beams]
  alignas(64) Row offset;                             ///< from the beam's middle [beams]
  Placing placing;                                    ///< at the sweep's beginning
  Placing change;                                     ///< of the placing, in a second
  CloudLayout::Sweep sweep;
  Limits limits;
  bool seesFar;  ///< whether rays that leave the lidar are in the band

  void level(std::size_t count);
  void levelInTime(std::size_t count);
  void undoMotion(std::size_t count, const PlanarVelocity& motion);
  void measure(std::size_t count);
};

// The loops below are vectorized: no calls, no branches, each over rows of one quantity.

/// Puts points of the lidar's frame into the level one of the robot.
void CloudShape::Block::level(std::size_t count) {
  const auto [m, t] = placing;
  for (std::size_t i = 0; i < count; ++i) {
    const float px = x[i];
    const float py = y[i];
    const float pz = z[i];
    x[i] = m[0] * px + m[1] * py + m[2] * pz + t[0];
    y[i] = m[3] * px + m[4] * py + m[5] * pz + t[1];
    z[i] = m[6] * px + m[7] * py + m[8] * pz + t[2];
  }
}

/// Does the same while the robot sways: the rotation goes on evenly. During a sweep it changes by a
/// few degrees, so that its numbers do, too.
void CloudShape::Block::levelInTime(std::size_t count) {
  const auto [m, t] = placing;
  const auto [dm, dt] = change;
  const float begin = sweep.begin;
  for (std::size_t i = 0; i < count; ++i) {
    const float s = late[i] - begin;
    const float px = x[i];
    const float py = y[i];
    const float pz = z[i];
    x[i] = (m[0] + s * dm[0]) * px + (m[1] + s * dm[1]) * py + (m[2] + s * dm[2]) * pz +
           (t[0] + s * dt[0]);
    y[i] = (m[3] + s * dm[3]) * px + (m[4] + s * dm[4]) * py + (m[5] + s * dm[5]) * pz +
           (t[1] + s * dt[1]);
    z[i] = (m[6] + s * dm[6]) * px + (m[7] + s * dm[7]) * py + (m[8] + s * dm[8]) * pz +
           (t[2] + s * dt[2]);
  }
}

/// Puts points from the robot's frame at their own times into that at the stamp. Velocities are
/// constant, so the way is an arc: with a = turn * time it leads from the stamp to
/// time * (v sin(a)/a - w (1 - cos a)/a, v (1 - cos a)/a + w sin(a)/a). The series are right to
/// 2e-3 up to half a turn, where they end, and to 1e-6 up to a radian.
void CloudShape::Block::undoMotion(std::size_t count, const PlanarVelocity& motion) {
  const auto forward = static_cast<float>(motion.forward);
  const auto left = static_cast<float>(motion.left);
  const auto turn = static_cast<float>(motion.turn);
  const float longest = kPi / std::max(std::abs(turn), 1e-6F);
  for (std::size_t i = 0; i < count; ++i) {
    const float time = std::min(std::max(late[i], -longest), longest);
    const float a = turn * time;
    const float aa = a * a;
    const float sinc =
        1.0F + aa * (-1.0F / 6 + aa * (1.0F / 120 + aa * (-1.0F / 5040 + aa * (1.0F / 362880))));
    const float cosc = a * (0.5F + aa * (-1.0F / 24 + aa * (1.0F / 720 + aa * (-1.0F / 40320))));
    const float sine = a * sinc;
    const float cosine = 1.0F - a * cosc;
    const float px = x[i];
    const float py = y[i];
    x[i] = cosine * px - sine * py + time * (forward * sinc - left * cosc);
    y[i] = sine * px + cosine * py + time * (forward * cosc + left * sinc);
  }
}

/// Finds range and beam of each point, as the scanner would see them.
void CloudShape::Block::measure(std::size_t count) {
  const Limits at = limits;
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = x[i] - at.originX;
    const float dy = y[i] - at.originY;
    const float length = std::sqrt(dx * dx + dy * dy);
    // Of a point beyond the greatest range counts where its ray was at that range.
    const float share = std::min(at.maxRange / length, 1.0F);
    const float height = at.eye + (z[i] - at.eye) * share;
    const bool counts = (height >= at.minHeight) & (height <= at.maxHeight) &
                        (length >= at.minRange) & (length <= kFarthest);
    const float ax = std::abs(dx);
    const float ay = std::abs(dy);
    const float t = std::min(ax, ay) / std::max(ax, ay);
    const float tt = t * t;
    // Abramowitz and Stegun, 4.4.49: within 2e-8 for t in [0, 1].
    float angle = 0.0028662257F;
    angle = angle * tt - 0.0161657367F;
    angle = angle * tt + 0.0429096138F;
    angle = angle * tt - 0.0752896400F;
    angle = angle * tt + 0.1065626393F;
    angle = angle * tt - 0.1420889944F;
    angle = angle * tt + 0.1999355085F;
    angle = angle * tt - 0.3333314528F;
    angle = (angle * tt + 1.0F) * t;
    angle = ay > ax ? 0.5F * kPi - angle : angle;
    angle = dx < 0.0F ? kPi - angle : angle;
    angle = dy < 0.0F ? -angle : angle;
    const float place = std::min((angle + kPi) * at.beamsPerRadian + 0.5F, at.beams);
    range[i] = counts ? length : 0.0F;
    beam[i] = static_cast<std::int32_t>(counts ? place : 0.0F);
    offset[i] = place - 0.5F - static_cast<float>(beam[i]);
  }
}

void CloudBand::check() const {
  checkNumber("beams", beams, 8, 8192);
  checkNumber("the least height [m]", minHeight, -kHighest, kHighest);
  checkNumber("the greatest height [m]", maxHeight, -kHighest, kHighest);
  checkNumber("the least range [m]", minRange, kLeast, kMost);
  checkNumber("the greatest range [m]", maxRange, kLeast, kMost);
  if (!(minHeight < maxHeight))
    throw std::invalid_argument("the least height is " + std::to_string(minHeight) +
                                " m, must be below the greatest, " + std::to_string(maxHeight) +
                                " m");
  if (!(minRange < maxRange))
    throw std::invalid_argument("the least range is " + std::to_string(minRange) +
                                " m, must be below the greatest, " + std::to_string(maxRange) +
                                " m");
}

CloudShape::CloudShape(const CloudBand& band, const Eigen::Isometry3d& mount)
    : band_(band),
      mount_(mount),
      origin_{plain(mount.translation().x()), plain(mount.translation().y()), 0.0},
      block_(std::make_unique<Block>()) {
  band.check();
  const auto beams = static_cast<std::size_t>(band.beams);
  nearest_.resize(beams);
  means_.resize(beams);
  offsets_.resize(beams);
  ranges_.resize(beams);
  counts_.resize(beams);
  isFree_.resize(beams);
}

CloudShape::~CloudShape() = default;
CloudShape::CloudShape(CloudShape&&) noexcept = default;
CloudShape& CloudShape::operator=(CloudShape&&) noexcept = default;

Scanner CloudShape::scanner() const {
  Scanner scanner;
  scanner.mount = origin_;
  scanner.beams = band_.beams;
  scanner.firstAngle = -std::numbers::pi;
  scanner.angleStep = kTurn / band_.beams;
  scanner.maxRange = band_.maxRange;
  return scanner;
}

/// Sets what holds for all points of a cloud.
void CloudShape::place(const CloudLayout& cloud, const SweepMotion& motion) {
  block_->sweep = cloud.sweep();
  const float seconds = block_->sweep.end - block_->sweep.begin;
  block_->placing = placingOf(motion.tiltAtBegin, mount_);
  block_->change = {};
  if (seconds > 0.0F)
    block_->change = changeOf(block_->placing, placingOf(motion.tiltAtEnd, mount_), seconds);
  Limits& limits = block_->limits;
  limits.originX = static_cast<float>(origin_.x);
  limits.originY = static_cast<float>(origin_.y);
  limits.eye = block_->placing.shift[2] + 0.5F * seconds * block_->change.shift[2];
  limits.minHeight = static_cast<float>(band_.minHeight);
  limits.maxHeight = static_cast<float>(band_.maxHeight);
  limits.minRange = static_cast<float>(band_.minRange);
  limits.maxRange = static_cast<float>(band_.maxRange);
  limits.beams = static_cast<float>(band_.beams);
  limits.beamsPerRadian = limits.beams / (2.0F * kPi);
  block_->seesFar = limits.eye >= limits.minHeight && limits.eye <= limits.maxHeight;
}

/// Adds measured points to their beams.
void CloudShape::takeBlock(std::size_t count) {
  const auto beams = static_cast<std::uint32_t>(band_.beams);
  const float maxRange = block_->limits.maxRange;
  for (std::size_t i = 0; i < count; ++i) {
    const float range = block_->range[i];
    if (!(range > 0.0F)) continue;
    auto beam = static_cast<std::uint32_t>(block_->beam[i]);
    if (beam >= beams) beam = 0;
    if (range >= maxRange) {
      if (block_->seesFar) isFree_[beam] = 1;
      continue;
    }
    nearest_[beam] = std::min(nearest_[beam], range);
    kept_[keptCount_++] = {beam, range, block_->offset[i]};
  }
}

std::span<const float> CloudShape::fit(const CloudLayout& cloud, const SweepMotion& motion,
                                       std::string& why) {
  place(cloud, motion);
  std::fill(nearest_.begin(), nearest_.end(), std::numeric_limits<float>::infinity());
  std::fill(isFree_.begin(), isFree_.end(), std::uint8_t{0});
  keptCount_ = 0;
  kept_.resize(std::max(kept_.size(), cloud.rows() * cloud.columns()));
  Block& block = *block_;
  for (std::size_t row = 0; row < cloud.rows(); ++row) {
    for (std::size_t first = 0; first < cloud.columns(); first += kBlock) {
      const std::size_t count = std::min(kBlock, cloud.columns() - first);
      cloud.readPlaces(row, first, std::span(block.x).first(count), std::span(block.y).first(count),
                       std::span(block.z).first(count));
      if (cloud.hasTimes()) {
        cloud.readTimes(row, first, std::span(block.late).first(count));
        block.levelInTime(count);
        block.undoMotion(count, motion.velocity);
      } else {
        block.level(count);
      }
      block.measure(count);
      takeBlock(count);
    }
  }
  return finish(why);
}

/// Returns the range of the nearest surface of each beam.
std::span<const float> CloudShape::finish(std::string& why) {
  std::fill(means_.begin(), means_.end(), 0.0F);
  std::fill(offsets_.begin(), offsets_.end(), 0.0F);
  std::fill(counts_.begin(), counts_.end(), 0U);
  const float slant = kSlant * static_cast<float>(kTurn) / static_cast<float>(band_.beams);
  for (std::size_t i = 0; i < keptCount_; ++i) {
    const auto [beam, range, offset] = kept_[i];
    const float behind = range - nearest_[beam];
    if (behind > kThickness + std::min(slant * nearest_[beam], kMostOfSlant)) continue;
    means_[beam] += behind;
    offsets_[beam] += offset;
    ++counts_[beam];
  }
  bool isAny = false;
  for (std::size_t beam = 0; beam < ranges_.size(); ++beam) {
    const auto count = static_cast<float>(counts_[beam]);
    if (counts_[beam] > 0) {
      means_[beam] = nearest_[beam] + means_[beam] / count;
      offsets_[beam] /= count;
    }
    isAny = isAny || counts_[beam] > 0 || isFree_[beam] != 0;
  }
  why = kNoPoint;
  if (!isAny) return {};
  why.clear();
  moveToMiddle();
  return ranges_;
}

/// Moves ranges to the middle of their beams, along the line between the beams on both sides, if
/// these are of one surface.
void CloudShape::moveToMiddle() {
  const std::size_t beams = ranges_.size();
  const float slant = kSlant * static_cast<float>(kTurn) / static_cast<float>(beams);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    if (counts_[beam] == 0) {
      ranges_[beam] = isFree_[beam] != 0 ? std::numeric_limits<float>::infinity()
                                         : std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    ranges_[beam] = means_[beam];
    const std::size_t before = (beam + beams - 1) % beams;
    const std::size_t after = (beam + 1) % beams;
    if (counts_[before] == 0 || counts_[after] == 0) continue;
    const float rise = means_[after] - means_[before];
    const float run = 2.0F + offsets_[after] - offsets_[before];  // at least 1
    const float bend = means_[beam] - 0.5F * (means_[after] + means_[before]);
    const float most = kThickness + std::min(2.0F * slant * means_[beam], kMostOfSlant);
    if (std::abs(rise) <= most && std::abs(bend) <= most)
      ranges_[beam] -= offsets_[beam] * rise / run;
  }
}

}  // namespace ortung::ros2
