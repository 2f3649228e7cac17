#include "RosNames.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace ortung::ros2 {
namespace {

bool isWord(std::string_view word) {
  const auto isLetter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !word.empty() && isLetter(word.front()) &&
         std::all_of(word.begin(), word.end(),
                     [&](char c) { return isLetter(c) || (c >= '0' && c <= '9'); });
}

/// Whether a name is words between slashes.
bool isPath(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  for (;;) {
    const std::size_t slash = name.find('/');
    if (!isWord(name.substr(0, slash))) return false;
    if (slash == name.npos) return true;
    name.remove_prefix(slash + 1);
  }
}

}  // namespace

std::string RosNames::full() const { return (space == "/" ? "" : space) + "/" + node; }

std::string RosNames::expand(const std::string& name) const {
  if (name.starts_with('/')) return name;
  if (name == "~") return full();
  if (name.starts_with("~/")) return full() + name.substr(1);
  return (space == "/" ? "" : space) + "/" + name;
}

std::string RosNames::resolve(const std::string& name) const {
  const std::string whole = expand(name);
  const auto found = std::find_if(remaps.begin(), remaps.end(),
                                  [&](const auto& rule) { return expand(rule.first) == whole; });
  return found == remaps.end() ? whole : expand(found->second);
}

void RosNames::check() const {
  if (!isWord(node))
    throw std::invalid_argument("the node is called '" + node +
                                "', expected letters, digits and _, not a digit first");
  if (space != "/" && (!space.starts_with('/') || !isPath(space)))
    throw std::invalid_argument("the namespace is '" + space + "', expected one as /robot1");
  for (const auto& [from, to] : remaps)
    for (const std::string& name : {from, to})
      if (!isPath(expand(name)))
        throw std::invalid_argument("'" + from + ":=" + to + "': expected names of topics");
}

}  // namespace ortung::ros2
