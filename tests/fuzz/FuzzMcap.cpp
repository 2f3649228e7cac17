// An MCAP file, whole, and the input as a message of each type.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ortung/ros2/McapReader.hpp"
#include "ortung/ros2/McapWriter.hpp"
#include "ortung/ros2/Messages.hpp"

namespace {

using namespace ortung::ros2;

template <class M>
void readMessage(std::string_view bytes) {
  std::string why;
  const auto message = fromCdr<M>(bytes, why);
  if (message.has_value() == why.empty()) {
    if (!message) return;
    // What was read is written so that it is read again as the same bytes.
    const std::string written = toCdr(*message);
    const auto again = fromCdr<M>(written, why);
    if (!again || toCdr(*again) != written) std::abort();
    return;
  }
  std::abort();
}

void readFile(const std::string& bytes) {
  std::istringstream in(bytes);
  try {
    McapReader reader(in, "input");
    for (McapMessage message; reader.next(message);) {
      if (message.channel == nullptr) std::abort();
      readMessage<LaserScan>(message.data);
    }
  } catch (const std::runtime_error& error) {
    if (*error.what() == '\0') std::abort();
  }
}

/// A sound file around the input's bytes, a few of which change it: so what lies behind magic,
/// lengths and checksums is reached, too.
std::string fileAround(std::string_view bytes) {
  std::string file;
  McapWriter::Options options;
  options.compression = static_cast<McapCompression>(bytes.empty() ? 0 : bytes[0] & 1);
  options.isChunked = !bytes.empty() && (bytes[0] & 2) != 0;
  McapWriter writer([&](std::string_view piece) { file += piece; }, options);
  const auto schema = writer.addSchema("sensor_msgs/msg/LaserScan", "ros2msg", "");
  const auto channel = writer.addChannel(schema, "/scan", "cdr", {});
  for (int i = 0; i < 3; ++i) writer.write(channel, 1, bytes);
  writer.finish();
  for (std::size_t i = 0; i + 2 < std::min<std::size_t>(bytes.size(), 12); i += 3) {
    const std::size_t at =
        static_cast<std::uint8_t>(bytes[i]) * 256U + static_cast<std::uint8_t>(bytes[i + 1]);
    file[at % file.size()] = bytes[i + 2];
  }
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  readFile(std::string(text));
  readFile(fileAround(text));
  readMessage<LaserScan>(text);
  readMessage<Odometry>(text);
  readMessage<TfMessage>(text);
  readMessage<PoseStamped>(text);
  readMessage<PoseWithCovarianceStamped>(text);
  readMessage<PoseArray>(text);
  readMessage<OccupancyGrid>(text);
  readMessage<Range>(text);
  readMessage<Image>(text);
  readMessage<PointCloud>(text);
  readMessage<DiagnosticArray>(text);
  readMessage<Words>(text);
  readMessage<Twist>(text);
  readMessage<TwistStamped>(text);
  readMessage<RosClock>(text);
  return 0;
}
