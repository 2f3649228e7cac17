#include "SweepFigures.hpp"

#include <algorithm>
#include <limits>

#include "ortung/base/Nearest.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostNamed = 6;

void collect(const Json& json, const std::string& path, std::size_t most,
             std::vector<std::string>& paths) {
  if (paths.size() >= most) return;
  const auto below = [&](const std::string& word) {
    return path.empty() ? word : path + "." + word;
  };
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) collect(value, below(key), most, paths);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i)
      collect(json[i], below(std::to_string(i)), most, paths);
  } else if (!path.empty() && !json.is_string()) {
    paths.push_back(path);
  }
}

/// Returns the figure that was meant, or "": one that is written nearly so, or whose end is it.
std::string meant(const std::string& path, const std::vector<std::string>& there) {
  for (const std::string& figure : there)
    if (figure.ends_with("." + path)) return figure;
  return nearest(path, there);
}

}  // namespace

std::optional<double> figureAt(const Json& json, const std::string& path) {
  const Json* at = &json;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string word = path.substr(begin, end - begin);
    if (at->is_object() && at->contains(word)) {
      at = &(*at)[word];
    } else if (at->is_array() && !word.empty() && word.size() < 7 &&
               word.find_first_not_of("0123456789") == word.npos && std::stoul(word) < at->size()) {
      at = &(*at)[std::stoul(word)];
    } else {
      return std::nullopt;
    }
    begin = end + 1;
  }
  if (at->is_boolean()) return at->get<bool>() ? 1.0 : 0.0;
  if (at->is_null()) return std::numeric_limits<double>::quiet_NaN();
  return at->is_number() ? std::optional(at->get<double>()) : std::nullopt;
}

std::vector<std::string> figuresIn(const Json& json, std::size_t most) {
  std::vector<std::string> paths;
  collect(json, "", most, paths);
  return paths;
}

std::string noFigure(const std::string& path, const std::vector<std::string>& there) {
  std::string text = "no finished task has a figure '" + path + "'";
  const std::string one = meant(path, there);
  if (!one.empty()) text += ": did you mean '" + one + "'?";
  std::string some;
  std::size_t named = 0;
  // Of a table those in it, as 'summary' is the begin of 'summary.0.right.share'.
  const bool isTable = std::any_of(there.begin(), there.end(), [&](const std::string& figure) {
    return figure.starts_with(path + ".");
  });
  for (const std::string& figure : there) {
    if (isTable && !figure.starts_with(path + ".")) continue;
    if (named++ < kMostNamed) some += (some.empty() ? "" : ", ") + figure;
  }
  if (named > kMostNamed) some += ", ... (--json writes all)";
  return some.empty() ? text : text + (one.empty() ? "; there are " : " There are ") + some;
}

}  // namespace ortung::app
