#include "RosArguments.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace ortung::ros2 {
namespace {

std::pair<std::string, std::string> assignment(const std::string& option, const std::string& text) {
  const std::size_t sign = text.find(":=");
  if (sign == text.npos || sign == 0 || sign + 2 == text.size())
    throw std::invalid_argument(option + " " + text + ": expected NAME:=VALUE");
  return {text.substr(0, sign), text.substr(sign + 2)};
}

template <std::size_t N>
bool isOneOf(const std::string& word, const std::array<const char*, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A rule may be for a node of some name alone: "NODE:FROM:=TO".
void addRemap(const std::string& option, const std::string& text, RosArguments& all) {
  auto [from, to] = assignment(option, text);
  if (const std::size_t colon = from.find(':'); colon != from.npos) {
    if (from.substr(0, colon) != all.names.node) return;
    from.erase(0, colon + 1);
  }
  if (from == "__node" || from == "__name") {
    all.names.node = to;
    all.namesNode = true;
  } else if (from == "__ns") {
    all.names.space = to;
  } else {
    all.names.remaps.emplace_back(from, to);
  }
}

}  // namespace

RosArguments RosArguments::read(const std::vector<std::string>& words, const std::string& node) {
  constexpr std::array kWithoutValue = {
      "--enable-rosout-logs",  "--disable-rosout-logs",      "--enable-stdout-logs",
      "--disable-stdout-logs", "--enable-external-lib-logs", "--disable-external-lib-logs"};
  constexpr std::array kWithValue = {"--log-level", "--log-config-file", "--log-file-name",
                                     "--enclave", "-e"};
  RosArguments all;
  all.names.node = node;
  bool isForRos = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--ros-args" || (isForRos && word == "--")) {
      isForRos = word == "--ros-args";
      continue;
    }
    if (!isForRos) {
      all.others.push_back(word);
      continue;
    }
    if (isOneOf(word, kWithoutValue)) continue;
    const bool isKnown = word == "-r" || word == "--remap" || word == "-p" || word == "--param" ||
                         word == "--params-file" || isOneOf(word, kWithValue);
    if (!isKnown)
      throw std::invalid_argument("--ros-args: found '" + word +
                                  "', expected -r, -p or --params-file");
    if (++i == words.size()) throw std::invalid_argument(word + ": its value is missing");
    if (word == "-r" || word == "--remap") addRemap(word, words[i], all);
    if (word == "--params-file") all.parameters.push_back({words[i], "", ""});
    if (word == "-p" || word == "--param") {
      auto [name, value] = assignment(word, words[i]);
      // "NODE:NAME" is for a node of that name.
      const std::size_t colon = name.find(':');
      if (colon != name.npos && name.substr(0, colon) != all.names.node) continue;
      if (colon != name.npos) name.erase(0, colon + 1);
      all.parameters.push_back({"", name, value});
    }
  }
  all.names.check();
  return all;
}

}  // namespace ortung::ros2
