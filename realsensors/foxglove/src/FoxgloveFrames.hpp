#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// Binary messages of the protocol; numbers are little-endian.
namespace ortung::foxglove {

/// A request of a client's time line.
struct PlaybackRequest {
  bool isPlay = false;                ///< whether to play, else pause
  float speed = 1.0F;                 ///< record time / real time, in (0, 1000]
  std::optional<std::uint64_t> seek;  ///< time to seek [ns since 1970]; nothing: none
  std::string id;                     ///< identity of the request
};

enum class PlaybackStatus : std::uint8_t { kPlaying, kPaused, kBuffering, kEnded };

struct PlaybackState {
  PlaybackStatus status = PlaybackStatus::kPaused;
  std::uint64_t time = 0;  ///< time of the record [ns since 1970]
  float speed = 1.0F;
  bool hasSought = false;
  std::string request = {};  ///< identity of the request that it answers; "": none
};

/// Encodes a message of a channel. @param time [ns since 1970]
std::string messageFrame(std::uint32_t subscription, std::uint64_t time, std::string_view message);
/// Encodes the world's time. @param time [ns since 1970]
std::string timeFrame(std::uint64_t time);
std::string playbackFrame(const PlaybackState& state);
/// Whether a client's binary message is one that it publishes: the number of its channel (4 bytes)
/// and the message follow the first byte.
bool isPublished(std::string_view bytes);
/// Decodes a client's binary message; nothing if it is not a valid request.
std::optional<PlaybackRequest> parsePlaybackRequest(std::string_view bytes);

}  // namespace ortung::foxglove
