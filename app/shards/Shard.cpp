#include "Shard.hpp"

#include <charconv>

#include "Console.hpp"

namespace ortung::app {

Shard readShard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool isParted = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  const auto count = isParted ? std::from_chars(number.ptr + 1, end, shard.count) : number;
  if (!isParted || count.ec != std::errc() || count.ptr != end)
    throw UsageError("--shard is '" + text + "', expected I/N, e.g. 2/4");
  if (shard.number < 1 || shard.number > shard.count || shard.count > kMostShards)
    throw UsageError("--shard is '" + text + "', expected I from 1 to N, and N up to " +
                     std::to_string(kMostShards));
  return shard;
}

std::string toText(const Shard& shard) {
  return std::to_string(shard.number) + "/" + std::to_string(shard.count);
}

}  // namespace ortung::app
