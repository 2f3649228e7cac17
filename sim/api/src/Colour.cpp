#include "ortung/sim_api/Colour.hpp"

#include <charconv>
#include <utility>

namespace ortung {
namespace {

constexpr std::pair<const char*, std::uint32_t> kNamed[] = {
    {"black", 0x000000},  {"blue", 0x0000ff},   {"brown", 0x8b4513},  {"cyan", 0x00ffff},
    {"green", 0x008000},  {"grey", 0x808080},   {"gray", 0x808080},   {"magenta", 0xff00ff},
    {"orange", 0xffa500}, {"pink", 0xffc0cb},   {"purple", 0x800080}, {"red", 0xff0000},
    {"white", 0xffffff},  {"yellow", 0xffff00},
};

}  // namespace

std::optional<std::uint32_t> rgbOf(std::string_view colour) {
  for (const auto& [name, word] : kNamed)
    if (colour == name) return word;
  if (colour.size() != 7 || colour[0] != '#') return std::nullopt;
  std::uint32_t word = 0;
  const char* end = colour.data() + colour.size();
  const auto parsed = std::from_chars(colour.data() + 1, end, word, 16);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return word;
}

}  // namespace ortung
