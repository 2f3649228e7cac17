#include "ortung/server/DescribeText.hpp"

#include "Request.hpp"

namespace ortung {
namespace {

using server::kLongestDescription;
using server::oneWord;
using server::printable;
using server::shown;

std::string objectText(const ServedObject& object) {
  return "object=" + object.name + " kind=" + oneWord(object.kind) +
         (object.radius > 0.0 ? " radius_m=" + shown(object.radius) : "") +
         (object.height > 0.0 ? " height_m=" + shown(object.height) : "") +
         (object.colour.empty() ? "" : " colour=" + oneWord(object.colour));
}

}  // namespace

std::vector<std::string> worldText(const WorldDescription& world) {
  std::string line = "world=" + oneWord(world.name) + " kind=" + world.kind +
                     " fingerprint=" + oneWord(world.fingerprint);
  if (const auto& bounds = world.bounds)
    line += " x_min_m=" + shown(bounds->xMin) + " y_min_m=" + shown(bounds->yMin) +
            " x_max_m=" + shown(bounds->xMax) + " y_max_m=" + shown(bounds->yMax);
  if (world.length) line += " start_us=0 end_us=" + std::to_string(*world.length);
  std::vector<std::string> lines = {line};
  for (const ServedObject& object : world.objects) lines.push_back(objectText(object));
  return lines;
}

std::vector<std::string> robotText(std::span<const ServedFeature> features,
                                   std::span<const std::string> abilities) {
  std::vector<std::string> lines;
  for (const ServedFeature& feature : features)
    lines.push_back(toText(feature.id) + " " + printable(feature.wordsHelp, kLongestDescription));
  for (const ServedFeature& feature : features)
    if (!feature.format.empty())
      lines.push_back("format " + toText(feature.id) + " " + feature.format);
  for (const ServedFeature& feature : features)
    lines.push_back("mount " + toText(feature.id) + " x_m=" + shown(feature.mount.x) +
                    " y_m=" + shown(feature.mount.y) + " theta_rad=" + shown(feature.mount.theta));
  for (const std::string& ability : abilities)
    lines.push_back(printable(ability, kLongestDescription));
  return lines;
}

}  // namespace ortung
