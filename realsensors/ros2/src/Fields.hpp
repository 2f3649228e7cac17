#pragma once

#include <concepts>
#include <type_traits>

#include "ortung/ros2/Messages.hpp"

// The fields of each message in their order, for both writers and readers.
namespace ortung::ros2 {

/// Whether T is M or const M.
template <class T, class M>
concept Is = std::same_as<std::remove_const_t<T>, M>;

template <class A>
void fields(A& a, Is<Header> auto& m) {
  a.time(m.stamp);
  a(m.frame);
}
template <class A>
void fields(A& a, Is<Vector3> auto& m) {
  a(m.x);
  a(m.y);
  a(m.z);
}
template <class A>
void fields(A& a, Is<Quaternion> auto& m) {
  a(m.x);
  a(m.y);
  a(m.z);
  a(m.w);
}
template <class A>
void fields(A& a, Is<Pose> auto& m) {
  a(m.position);
  a(m.orientation);
}
template <class A>
void fields(A& a, Is<LaserScan> auto& m) {
  a(m.header);
  a(m.angleMin);
  a(m.angleMax);
  a(m.angleIncrement);
  a(m.timeIncrement);
  a(m.scanTime);
  a(m.rangeMin);
  a(m.rangeMax);
  a(m.ranges);
  a(m.intensities);
}
template <class A>
void fields(A& a, Is<Odometry> auto& m) {
  a(m.header);
  a(m.childFrame);
  a(m.pose);
  a(m.poseCovariance);
  a(m.linear);
  a(m.angular);
  a(m.twistCovariance);
}
template <class A>
void fields(A& a, Is<Twist> auto& m) {
  a(m.linear);
  a(m.angular);
}
template <class A>
void fields(A& a, Is<TwistStamped> auto& m) {
  a(m.header);
  a(m.twist);
}
template <class A>
void fields(A& a, Is<RosClock> auto& m) {
  a.time(m.time);
}
template <class A>
void fields(A& a, Is<TransformStamped> auto& m) {
  a(m.header);
  a(m.childFrame);
  a(m.transform);
}
template <class A>
void fields(A& a, Is<TfMessage> auto& m) {
  a(m.transforms);
}
template <class A>
void fields(A& a, Is<PoseStamped> auto& m) {
  a(m.header);
  a(m.pose);
}
template <class A>
void fields(A& a, Is<PoseWithCovarianceStamped> auto& m) {
  a(m.header);
  a(m.pose);
  a(m.covariance);
}
template <class A>
void fields(A& a, Is<PoseArray> auto& m) {
  a(m.header);
  a(m.poses);
}
template <class A>
void fields(A& a, Is<Particle> auto& m) {
  a(m.pose);
  a(m.weight);
}
template <class A>
void fields(A& a, Is<ParticleCloud> auto& m) {
  a(m.header);
  a(m.particles);
}
template <class A>
void fields(A& a, Is<OccupancyGrid> auto& m) {
  a(m.header);
  a.time(m.mapLoadTime);
  a(m.resolution);
  a(m.width);
  a(m.height);
  a(m.origin);
  a(m.data);
}
template <class A>
void fields(A& a, Is<Range> auto& m) {
  a(m.header);
  a(m.radiationType);
  a(m.fieldOfView);
  a(m.minRange);
  a(m.maxRange);
  a(m.range);
}
template <class A>
void fields(A& a, Is<Image> auto& m) {
  a(m.header);
  a(m.height);
  a(m.width);
  a(m.encoding);
  a(m.isBigEndian);
  a(m.step);
  a(m.data);
}

template <class A>
void fields(A& a, Is<DiagnosticArray::KeyValue> auto& m) {
  a(m.key);
  a(m.value);
}
template <class A>
void fields(A& a, Is<DiagnosticArray::Status> auto& m) {
  a(m.level);
  a(m.name);
  a(m.message);
  a(m.hardwareId);
  a(m.values);
}
template <class A>
void fields(A& a, Is<DiagnosticArray> auto& m) {
  a(m.header);
  a(m.status);
}

template <class A>
void fields(A& a, Is<Imu> auto& m) {
  a(m.header);
  a(m.orientation);
  a(m.orientationCovariance);
  a(m.angular);
  a(m.angularCovariance);
  a(m.acceleration);
  a(m.accelerationCovariance);
}

template <class A>
void fields(A& a, Is<PointCloud::Field> auto& m) {
  a(m.name);
  a(m.offset);
  a(m.type);
  a(m.count);
}
template <class A>
void fields(A& a, Is<PointCloud> auto& m) {
  a(m.header);
  a(m.height);
  a(m.width);
  a(m.fields);
  a(m.isBigEndian);
  a(m.pointStep);
  a(m.rowStep);
  a(m.data);
  a(m.isDense);
}
template <class A>
void fields(A& a, Is<Words::Dimension> auto& m) {
  a(m.label);
  a(m.size);
  a(m.stride);
}
template <class A>
void fields(A& a, Is<Words> auto& m) {
  a(m.dimensions);
  a(m.offset);
  a(m.data);
}

}  // namespace ortung::ros2
