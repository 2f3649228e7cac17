#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// Binary messages of the protocol; numbers have the lowest byte first.
namespace ortung::foxglove {

/// What a client's time line wants.
struct PlaybackRequest {
  bool isPlay = false;
  float speed = 1.0F;                 ///< times real time, above 0, at most 1000
  std::optional<std::uint64_t> seek;  ///< [ns]
  std::string id;
};

enum class PlaybackStatus : std::uint8_t { kPlaying, kPaused, kBuffering, kEnded };

struct PlaybackState {
  PlaybackStatus status = PlaybackStatus::kPaused;
  std::uint64_t time = 0;  ///< [ns]
  float speed = 1.0F;
  bool hasSought = false;
  std::string request = {};  ///< that it answers; "": none
};

/// A message of a channel. @param time [ns]
std::string messageFrame(std::uint32_t subscription, std::uint64_t time, std::string_view message);
/// @param time of the world [ns]
std::string timeFrame(std::uint64_t time);
std::string playbackFrame(const PlaybackState& state);
/// Reads a client's binary message; nothing for anything but a request that makes sense.
std::optional<PlaybackRequest> parsePlaybackRequest(std::string_view bytes);

}  // namespace ortung::foxglove
