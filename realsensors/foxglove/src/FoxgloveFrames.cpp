#include "FoxgloveFrames.hpp"

#include <cmath>
#include <cstring>

namespace ortung::foxglove {
namespace {

constexpr char kMessageData = 1;
constexpr char kTime = 2;
constexpr char kPlaybackState = 5;
// Operations of clients.
constexpr char kClientMessage = 1;
constexpr char kPlaybackControl = 3;

template <class T>
void put(std::string& out, T number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}
template <class T>
bool take(std::string_view& bytes, T& number) {
  if (bytes.size() < sizeof number) return false;
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes.remove_prefix(sizeof number);
  return true;
}

}  // namespace

std::string messageFrame(std::uint32_t subscription, std::uint64_t time, std::string_view message) {
  std::string frame(1, kMessageData);
  frame.reserve(1 + sizeof subscription + sizeof time + message.size());
  put(frame, subscription);
  put(frame, time);
  frame += message;
  return frame;
}

std::string timeFrame(std::uint64_t time) {
  std::string frame(1, kTime);
  put(frame, time);
  return frame;
}

std::string playbackFrame(const PlaybackState& state) {
  std::string frame(1, kPlaybackState);
  put(frame, static_cast<std::uint8_t>(state.status));
  put(frame, state.time);
  put(frame, state.speed);
  put(frame, static_cast<std::uint8_t>(state.hasSought ? 1 : 0));
  put(frame, static_cast<std::uint32_t>(state.request.size()));
  frame += state.request;
  return frame;
}

bool isPublished(std::string_view bytes) {
  return !bytes.empty() && bytes.front() == kClientMessage;
}

std::optional<PlaybackRequest> parsePlaybackRequest(std::string_view bytes) {
  constexpr std::size_t kLongestId = 256;
  constexpr float kFastest = 1000.0F;
  PlaybackRequest request;
  std::uint8_t command = 0;
  std::uint8_t hasSeek = 0;
  std::uint64_t seek = 0;
  std::uint32_t length = 0;
  if (bytes.empty() || bytes[0] != kPlaybackControl) return std::nullopt;
  bytes.remove_prefix(1);
  if (!take(bytes, command) || !take(bytes, request.speed) || !take(bytes, hasSeek) ||
      !take(bytes, seek) || command > 1)
    return std::nullopt;
  // The first versions had no identity.
  if (take(bytes, length) && (length > bytes.size() || length > kLongestId)) return std::nullopt;
  if (!std::isfinite(request.speed) || request.speed <= 0.0F || request.speed > kFastest)
    return std::nullopt;
  request.isPlay = command == 0;
  if (hasSeek != 0) request.seek = seek;
  request.id = bytes.substr(0, length);
  return request;
}

}  // namespace ortung::foxglove
