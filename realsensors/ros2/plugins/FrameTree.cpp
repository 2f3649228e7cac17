#include "FrameTree.hpp"

#include <cmath>
#include <set>

namespace ortung::ros2 {
namespace {

constexpr std::size_t kMostFrames = 4096;
constexpr double kFarthest = 1e6;  // [m]

}  // namespace

double plain(double number) { return std::round(number * 1e6) / 1e6; }

bool PlanarMount::isLevel() const {
  constexpr double kUpright = 0.98;  // cosine of some 11 degrees
  return std::abs(up) >= kUpright;
}

PlanarMount onPlane(const Eigen::Isometry3d& sensor) {
  const Eigen::Matrix3d turn = sensor.linear();
  const Eigen::Vector3d place = sensor.translation();
  return {{plain(place.x()), plain(place.y()), std::atan2(turn(1, 0), turn(0, 0))}, turn(2, 2)};
}

bool FrameTree::add(const TransformStamped& transform, bool isStatic) {
  const auto& [position, q] = transform.transform;
  const Eigen::Vector3d place(position.x, position.y, position.z);
  const Eigen::Quaterniond turn(q.w, q.x, q.y, q.z);
  constexpr double kLeast = 1e-3;  // least length of a quaternion, which should be 1
  if (!place.allFinite() || place.norm() > kFarthest || !(turn.norm() > kLeast) ||
      !std::isfinite(turn.norm()))
    return false;
  const auto known = links_.find(transform.childFrame);
  if (known == links_.end() ? links_.size() >= kMostFrames : known->second.isStatic && !isStatic)
    return true;
  Link link{transform.header.frame, Eigen::Isometry3d::Identity(), isStatic};
  link.pose = Eigen::Translation3d(place) * turn.normalized();
  links_.insert_or_assign(transform.childFrame, std::move(link));
  return true;
}

std::set<std::string> FrameTree::frames() const {
  std::set<std::string> all;
  for (const auto& [child, link] : links_) {
    all.insert(child);
    all.insert(link.parent);
  }
  return all;
}

bool FrameTree::hasFrame(const std::string& frame) const { return links_.contains(frame); }

std::pair<std::string, Eigen::Isometry3d> FrameTree::climb(std::string frame,
                                                           const std::string& base,
                                                           bool staticAlone) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t steps = 0; steps < kMostFrames;
       ++steps) {  // limited, since links may form a circle
    const auto link = links_.find(frame);
    if (link == links_.end() || (!link->second.isStatic && (staticAlone || frame == base))) break;
    pose = link->second.pose * pose;
    frame = link->second.parent;
  }
  return {std::move(frame), pose};
}

std::optional<Eigen::Isometry3d> FrameTree::find(const std::string& frame,
                                                 const std::string& base) const {
  if (frame == base) return Eigen::Isometry3d::Identity();
  for (const bool staticAlone : {true, false}) {
    const auto [root, inRoot] = climb(frame, base, staticAlone);
    const auto [baseRoot, baseInRoot] = climb(base, base, staticAlone);
    if (root == baseRoot) return baseInRoot.inverse() * inRoot;
  }
  return std::nullopt;
}

std::vector<std::string> FrameTree::names() const {
  std::set<std::string> all;
  for (const auto& [child, link] : links_) {
    all.insert(child);
    all.insert(link.parent);
  }
  return {all.begin(), all.end()};
}

}  // namespace ortung::ros2
