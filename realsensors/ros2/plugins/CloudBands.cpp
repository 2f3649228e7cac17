#include "CloudBands.hpp"

#include <stdexcept>

#include "ortung/core/SourceOptions.hpp"

namespace ortung::ros2 {

void CloudBands::takeHeights(const std::string& text) {
  for (std::string rest = text; !rest.empty();) {
    const std::string one = rest.substr(0, rest.find(';'));
    rest.erase(0, one.size() + 1);
    const std::size_t colon = one.rfind(':');
    const std::size_t begin = colon == one.npos ? 0 : colon + 1;
    const auto numbers = parseNumbers(std::string_view(one).substr(begin));
    if (!numbers || numbers->size() != 2 || colon == 0)
      throw std::invalid_argument("has '" + one +
                                  "', must be LOW,HIGH or TOPIC:LOW,HIGH in m, and ';' between "
                                  "two");
    if (colon == one.npos) {
      each.minHeight = (*numbers)[0];
      each.maxHeight = (*numbers)[1];
    } else {
      heights[one.substr(0, colon)] = {(*numbers)[0], (*numbers)[1]};
    }
  }
}

CloudBand CloudBands::of(const std::string& topic) const {
  CloudBand band = each;
  const auto own = heights.find(topic);
  if (own == heights.end()) return band;
  band.minHeight = own->second.first;
  band.maxHeight = own->second.second;
  return band;
}

void CloudBands::check() const {
  each.check();
  for (const auto& [topic, own] : heights) of(topic).check();
}

}  // namespace ortung::ros2
