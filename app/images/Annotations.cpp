#include "Annotations.hpp"

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ortung/base/Angles.hpp"
#include "ortung/pictures/CameraPicture.hpp"

namespace ortung::app {
namespace {

constexpr const char* kImages = "images";  ///< the only key of a data set

constexpr double kConcealed = 0.75;  ///< share of its box; a thing that shows less is concealed
constexpr int kCorners = 12;         ///< points of a thing's circle that are projected

std::string typeOf(const WorldObject& object) {
  if (object.kind == "ball" || object.kind == "robot") return object.kind;
  if (object.kind == "goal") return object.isRound ? "goalpost" : "top_bar";
  return object.kind == "wall" ? "" : "obstacle";
}

/// Returns the area of the box that the thing would have if nothing hid it.
double boxOf(const WorldObject& object, const CameraView& camera, const Pose2& sensor) {
  double uLow = 1e9, uHigh = -1e9, vLow = 1e9, vHigh = -1e9;
  const ImageSize size = camera.model().size();
  for (int i = 0; i < 2 * kCorners; ++i) {
    const double angle = kTurn * (i / 2) / kCorners;
    const Pose2 inField{object.pose.x + object.radius * std::cos(angle),
                        object.pose.y + object.radius * std::sin(angle), 0.0};
    const Pose2 p = inverse(sensor) * inField;
    const auto pixel = camera.pixelOf({p.x, p.y, i % 2 == 0 ? object.zLow : object.zHigh});
    if (!pixel) continue;
    uLow = std::min(uLow, std::max(pixel->u, 0.0));
    uHigh = std::max(uHigh, std::min(pixel->u, size.width - 1.0));
    vLow = std::min(vLow, std::max(pixel->v, 0.0));
    vHigh = std::max(vHigh, std::min(pixel->v, size.height - 1.0));
  }
  return uHigh > uLow && vHigh > vLow ? (uHigh - uLow) * (vHigh - vLow) : 0.0;
}

void emitPose(YAML::Emitter& out, double x, double y, double z, const Eigen::Quaterniond& q) {
  out << YAML::BeginMap << YAML::Key << "position" << YAML::Value << YAML::Flow << YAML::BeginMap
      << YAML::Key << "x" << YAML::Value << x << YAML::Key << "y" << YAML::Value << y << YAML::Key
      << "z" << YAML::Value << z << YAML::EndMap << YAML::Key << "orientation" << YAML::Value
      << YAML::Flow << YAML::BeginMap << YAML::Key << "x" << YAML::Value << q.x() << YAML::Key
      << "y" << YAML::Value << q.y() << YAML::Key << "z" << YAML::Value << q.z() << YAML::Key << "w"
      << YAML::Value << q.w() << YAML::EndMap << YAML::EndMap;
}

void emitPoint(YAML::Emitter& out, int u, int v) {
  out << YAML::Flow << YAML::BeginSeq << u << v << YAML::EndSeq;
}

void emit(YAML::Emitter& out, const Annotation& one) {
  out << YAML::BeginMap << YAML::Key << "type" << YAML::Value << one.type;
  out << YAML::Key << "in_image" << YAML::Value << one.isSeen;
  if (one.isSeen) {
    out << YAML::Key << "blurred" << YAML::Value << false;
    out << YAML::Key << "concealed" << YAML::Value << one.isConcealed;
    out << YAML::Key << "vector" << YAML::Value << YAML::BeginSeq;
    emitPoint(out, one.left, one.top);
    if (one.type == "goalpost" || one.type == "top_bar") {  // four corners, in order
      emitPoint(out, one.right, one.top);
      emitPoint(out, one.right, one.bottom);
      emitPoint(out, one.left, one.bottom);
    } else {
      emitPoint(out, one.right, one.bottom);
    }
    out << YAML::EndSeq;
    out << YAML::Key << "pose" << YAML::Value;
    emitPose(out, one.pose.x, one.pose.y, one.z,
             Eigen::Quaterniond(Eigen::AngleAxisd(one.pose.theta, Eigen::Vector3d::UnitZ())));
  }
  out << YAML::EndMap;
}

/// Returns the angle between the left and the right end of the middle row [degrees].
std::optional<double> fieldOfView(const CameraView& camera) {
  const ImageSize size = camera.model().size();
  const double v = 0.5 * (size.height - 1.0);
  const auto left = camera.model().unproject({0.0, v});
  const auto right = camera.model().unproject({size.width - 1.0, v});
  if (!left || !right) return std::nullopt;
  return degrees(std::acos(
      std::clamp(left->x * right->x + left->y * right->y + left->z * right->z, -1.0, 1.0)));
}

void emitMetadata(YAML::Emitter& out, const PictureNotes& notes) {
  out << YAML::BeginMap;
  if (notes.camera != nullptr)
    if (const auto fov = fieldOfView(*notes.camera))
      out << YAML::Key << "fov" << YAML::Value << *fov;
  if (!notes.location.empty())
    out << YAML::Key << "location" << YAML::Value << YAML::DoubleQuoted << notes.location;
  out << YAML::Key << "tags" << YAML::Value << YAML::Flow << YAML::BeginSeq << YAML::DoubleQuoted
      << notes.tag << YAML::EndSeq;
  out << YAML::Key << "imageset_id" << YAML::Value << YAML::DoubleQuoted << notes.set;
  if (notes.camera != nullptr && notes.sensor) {
    const CameraPose pose = cameraPoseOf(*notes.camera, *notes.sensor);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(pose.axes.data());
    out << YAML::Key << "camera_pose" << YAML::Value;
    emitPose(out, pose.position[0], pose.position[1], pose.position[2],
             Eigen::Quaterniond(Eigen::Matrix3d(axes)));
  }
  out << YAML::EndMap;
}

}  // namespace

std::vector<Annotation> annotationsOf(std::span<const std::uint32_t> things, const World& world,
                                      const CameraView& camera, const Pose2& sensor) {
  const std::span<const WorldObject> objects = world.objects();
  std::vector<Annotation> all(objects.size());
  const auto width = static_cast<std::size_t>(camera.model().size().width);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const std::size_t object = things[i] >> 8;
    if (object == 0 || object > all.size()) continue;
    Annotation& one = all[object - 1];
    const auto u = static_cast<int>(i % width);
    const auto v = static_cast<int>(i / width);
    one.left = one.isSeen ? std::min(one.left, u) : u;
    one.right = one.isSeen ? std::max(one.right, u) : u;
    if (!one.isSeen) one.top = v;
    one.bottom = v;
    one.isSeen = true;
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const WorldObject& object = objects[i];
    Annotation& one = all[i];
    one.type = typeOf(object);
    one.pose = object.pose;
    one.z = 0.5 * (object.zLow + object.zHigh);
    const double seen = (one.right - one.left + 1.0) * (one.bottom - one.top + 1.0);
    one.isConcealed = one.isSeen && seen < kConcealed * boxOf(object, camera, sensor);
  }
  // The data set has an annotation for balls and robots even if there are none.
  std::vector<Annotation> notes;
  for (const Annotation& one : all)
    if (one.isSeen && !one.type.empty()) notes.push_back(one);
  for (const char* type : {"ball", "robot"})
    if (std::none_of(notes.begin(), notes.end(), [&](const auto& one) { return one.type == type; }))
      notes.push_back({.type = type, .pose = {}});
  return notes;
}

std::string annotationYaml(const PictureNotes& notes) {
  YAML::Emitter out;
  out.SetDoublePrecision(9);
  out << YAML::BeginMap << YAML::Key << kImages << YAML::Value << YAML::BeginMap;
  out << YAML::Key << notes.file << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "width" << YAML::Value << notes.size.width;
  out << YAML::Key << "height" << YAML::Value << notes.size.height;
  out << YAML::Key << "annotations" << YAML::Value << YAML::BeginSeq;
  for (const Annotation& one : notes.annotations) emit(out, one);
  out << YAML::EndSeq << YAML::Key << "metadata" << YAML::Value;
  emitMetadata(out, notes);
  out << YAML::EndMap << YAML::EndMap << YAML::EndMap;
  const std::string text = out.c_str();
  return text.substr(text.find('\n') + 1) + "\n";  // without the line of the data set
}

std::string annotationsYaml(std::span<const std::string> pictures) {
  std::string text = std::string(kImages) + ":\n";
  for (const std::string& picture : pictures) text += picture;
  return pictures.empty() ? text + "  {}\n" : text;
}

}  // namespace ortung::app
