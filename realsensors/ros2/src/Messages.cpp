#include "ortung/ros2/Messages.hpp"

#include <type_traits>

#include "Cdr.hpp"
#include "Ros1.hpp"

namespace ortung::ros2 {

template <class M>
std::string toCdr(const M& message) {
  CdrWriter writer;
  writer(message);
  return writer.take();
}

namespace {

template <class M, class Reader>
std::optional<M> readWith(Reader reader, std::string& why) {
  std::optional<M> message(std::in_place);
  reader(*message);
  why = reader.why();
  if (!why.empty()) message.reset();
  return message;
}

}  // namespace

template <class M>
std::optional<M> fromCdr(std::string_view bytes, std::string& why) {
  return readWith<M>(CdrReader(bytes), why);
}

template <class M>
bool fromCdr(std::string_view bytes, M& message, std::string& why) {
  CdrReader reader(bytes);
  reader(message);
  why = reader.why();
  return why.empty();
}

template <class M>
std::optional<M> fromRos1(std::string_view bytes, std::string& why) {
  return readWith<M>(Ros1Reader(bytes), why);
}

#define ORTUNG_ROS2_MESSAGE(M)                                                       \
  template ORTUNG_API std::string toCdr(const M&);                                   \
  template ORTUNG_API std::optional<M> fromCdr(std::string_view, std::string&);      \
  template ORTUNG_API bool fromCdr(std::string_view, std::add_lvalue_reference_t<M>, \
                                   std::string&);                                    \
  template ORTUNG_API std::optional<M> fromRos1(std::string_view, std::string&);
ORTUNG_ROS2_MESSAGE(LaserScan)
ORTUNG_ROS2_MESSAGE(Odometry)
ORTUNG_ROS2_MESSAGE(Twist)
ORTUNG_ROS2_MESSAGE(TwistStamped)
ORTUNG_ROS2_MESSAGE(RosClock)
ORTUNG_ROS2_MESSAGE(TfMessage)
ORTUNG_ROS2_MESSAGE(PoseStamped)
ORTUNG_ROS2_MESSAGE(PoseWithCovarianceStamped)
ORTUNG_ROS2_MESSAGE(PoseArray)
ORTUNG_ROS2_MESSAGE(ParticleCloud)
ORTUNG_ROS2_MESSAGE(OccupancyGrid)
ORTUNG_ROS2_MESSAGE(Range)
ORTUNG_ROS2_MESSAGE(Image)
ORTUNG_ROS2_MESSAGE(Imu)
ORTUNG_ROS2_MESSAGE(PointCloud)
ORTUNG_ROS2_MESSAGE(DiagnosticArray)
ORTUNG_ROS2_MESSAGE(Words)
#undef ORTUNG_ROS2_MESSAGE

}  // namespace ortung::ros2
