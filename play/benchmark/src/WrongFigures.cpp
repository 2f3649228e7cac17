#include <cmath>
#include <nlohmann/json.hpp>

#include "ortung/benchmark/FootballMatrix.hpp"
#include "ortung/benchmark/GoalMatrix.hpp"

namespace ortung {
namespace {

using Json = nlohmann::ordered_json;

/// Greatest difference of figures: mathematical libraries differ in their last bits, and the
/// ratings' iteration ends a little earlier or later because of them.
constexpr double kSame = 1e-6;
constexpr std::size_t kShown = 60;  ///< greatest length of a value in a sentence

bool isSame(const Json& told, const Json& found) {
  if (!told.is_number() || !found.is_number()) return told == found;
  if (told.is_number_integer() && found.is_number_integer()) return told == found;
  return std::abs(told.get<double>() - found.get<double>()) <= kSame;
}

std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kShown) text = text.substr(0, kShown) + "...";
  return text;
}

/// Appends what differs, each with its place as a JSON pointer (RFC 6901).
void compare(const Json& told, const Json& found, const Json::json_pointer& place,
             std::vector<std::string>& wrong) {
  if (told.is_object() && found.is_object()) {
    for (const auto& [key, value] : found.items()) {
      if (told.contains(key))
        compare(told.at(key), value, place / key, wrong);
      else
        wrong.push_back((place / key).to_string() + " is missing, expected " + shown(value));
    }
    for (const auto& [key, value] : told.items())
      if (!found.contains(key))
        wrong.push_back((place / key).to_string() + " is " + shown(value) +
                        ", which is no figure of these episodes");
    return;
  }
  if (told.is_array() && found.is_array() && told.size() == found.size()) {
    for (std::size_t i = 0; i < found.size(); ++i) compare(told[i], found[i], place / i, wrong);
    return;
  }
  if (!isSame(told, found))
    wrong.push_back(place.to_string() + " is " + shown(told) + ", but the episodes give " +
                    shown(found));
}

template <class Matrix>
std::vector<std::string> differences(std::string_view json, const Matrix& matrix) {
  const Json told = Json::parse(json);
  const auto version = told.find("version");
  const bool isText = version != told.end() && version->is_string();
  const std::string text = toJson(matrix, isText ? version->get<std::string>() : "a version");
  std::vector<std::string> wrong;
  compare(told, Json::parse(text), Json::json_pointer(), wrong);
  return wrong;
}

}  // namespace

std::vector<std::string> wrongFigures(std::string_view json, const GoalMatrix& matrix) {
  return differences(json, matrix);
}
std::vector<std::string> wrongFigures(std::string_view json, const FootballMatrix& matrix) {
  return differences(json, matrix);
}

}  // namespace ortung
