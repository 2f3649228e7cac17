#include "LandmarkLabels.hpp"

#include <algorithm>
#include <cmath>

namespace ortung::app {
namespace {

constexpr std::size_t kMostLabels = 60;
constexpr std::size_t kLongestKind = 16;

}  // namespace

std::string commonKind(const FieldModel& field) {
  if (field.landmarks.empty()) return "";
  const std::string& kind = field.landmarks.front().kind;
  const bool isOne = std::all_of(field.landmarks.begin(), field.landmarks.end(),
                                 [&](const Landmark& mark) { return mark.kind == kind; });
  return isOne ? kind.substr(0, kLongestKind) : "";
}

std::vector<LandmarkLabel> labelsOf(const FieldModel& field, double letter, double right) {
  std::vector<LandmarkLabel> labels;
  if (field.landmarks.size() > kMostLabels) return labels;
  const bool isOneKind = !commonKind(field).empty();
  for (const Landmark& mark : field.landmarks) {
    LandmarkLabel label;
    if (!isOneKind) label.text = mark.kind.substr(0, kLongestKind) + " ";
    label.text += std::to_string(mark.identity);
    const double room = (1.0 + static_cast<double>(label.text.size())) * letter;
    label.isLeft =
        mark.x + room > right ||
        std::any_of(field.landmarks.begin(), field.landmarks.end(), [&](const Landmark& other) {
          return other.x > mark.x && other.x < mark.x + room && std::abs(other.y - mark.y) < letter;
        });
    labels.push_back(std::move(label));
  }
  return labels;
}

}  // namespace ortung::app
