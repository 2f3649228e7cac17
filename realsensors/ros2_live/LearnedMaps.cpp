#include "LearnedMaps.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace ortung::ros2 {

// Who could find two maps of one hash could as well send the wrong map.
std::uint64_t LearnedMaps::keyOf(std::span<const std::filesystem::path> files) {
  std::string all;
  for (const std::filesystem::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    if (!in.is_open() || in.bad())
      throw std::runtime_error(file.string() + ": can't be read, expected what a map was made to");
    all += std::to_string(bytes.size()) + ":" + bytes;
  }
  return std::hash<std::string_view>()(all);
}

std::optional<std::filesystem::path> LearnedMaps::find(std::uint64_t key) {
  const auto found =
      std::find_if(known_.begin(), known_.end(), [&](const auto& one) { return one.first == key; });
  if (found == known_.end()) return std::nullopt;
  std::error_code error;
  if (!std::filesystem::exists(found->second, error)) return std::nullopt;  // somebody tidied up
  known_.splice(known_.begin(), known_, found);
  return known_.front().second;
}

std::filesystem::path LearnedMaps::fileForNext() {
  if (known_.size() == kMost) known_.pop_back();
  const auto isUsed = [&](const std::filesystem::path& file) {
    return std::any_of(known_.begin(), known_.end(),
                       [&](const auto& one) { return one.second == file; });
  };
  for (std::size_t i = 1;; ++i) {
    auto file = folder_ / ("map" + std::to_string(i) + ".ortung");
    if (!isUsed(file)) return file;
  }
}

void LearnedMaps::keep(std::uint64_t key, const std::filesystem::path& tables) {
  std::erase_if(known_, [&](const auto& one) { return one.first == key || one.second == tables; });
  known_.emplace_front(key, tables);
}

}  // namespace ortung::ros2
