// What robots are told at cmd_vel, as anybody on the network may send it: any bytes at any time.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "VelocityCommand.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kMost = 0.5;
  constexpr ortung::Timestamp kPatience = 500'000;
  ortung::ros2::VelocityCommand command(
      {.mostForward = kMost, .mostTurn = kMost, .patience = kPatience});
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  ortung::Timestamp now = 0;
  while (rest.size() >= 2) {
    const auto kind = static_cast<std::uint8_t>(rest[0]);
    const std::string_view piece = rest.substr(2, static_cast<std::uint8_t>(rest[1]));
    rest.remove_prefix(2 + piece.size());
    (kind & 1) != 0 ? command.takeStamped(piece) : command.take(piece);
    now += ortung::Timestamp{kind} * 10'000 - 300'000;  // now and then the clock is set back
    const auto velocity = command.due(now);
    if (velocity && !(std::abs(velocity->forward) <= kMost && std::abs(velocity->turn) <= kMost))
      std::abort();
  }
  const auto last = command.due(now + kPatience);
  if (last && (last->forward != 0.0 || last->turn != 0.0)) std::abort();
  return 0;
}
