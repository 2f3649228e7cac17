#include "Request.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "ortung/base/Angles.hpp"
#include "ortung/server/ServedWorld.hpp"

namespace ortung::server {
namespace {

constexpr std::size_t kMostArguments = 256;

bool isPrintable(char c) { return c >= 0x20 && c < 0x7F; }

bool isTag(std::string_view word) {
  return word.size() >= 2 && word.size() <= 33 && word[0] == '#' && isName(word.substr(1));
}

std::string_view cutWord(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

/// Returns the length of KEY in "KEY=VALUE", whose key has small letters; 0 for other words.
std::size_t keyLength(std::string_view word) {
  const std::size_t equals = word.find('=');
  if (equals == word.npos || equals == 0) return 0;
  const std::string_view key = word.substr(0, equals);
  const bool good = std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  return good ? equals : 0;
}

[[noreturn]] void refuse(const std::string& text) { throw ServeError("syntax", text); }

template <class Number>
std::string digitsOf(Number value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

template <class Number>
Number parse(std::string_view text, const std::string& what, Number low, Number high) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= low && value <= high))
    throw ServeError("number", what + " is '" + printable(text) + "', expected a " +
                                   (std::is_integral_v<Number> ? "whole " : "") + "number from " +
                                   digitsOf(low) + " to " + digitsOf(high));
  return value;
}

}  // namespace

bool isName(std::string_view name) {
  return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

std::string printable(std::string_view text, std::size_t mostCharacters) {
  std::string safe(text.substr(0, mostCharacters));
  std::replace_if(safe.begin(), safe.end(), [](char c) { return !isPrintable(c); }, '?');
  return text.size() > mostCharacters ? safe + "..." : safe;
}

std::string oneWord(std::string_view text) {
  std::string word = printable(text);
  std::replace(word.begin(), word.end(), ' ', '_');
  return word;
}

std::string shown(double value) { return digitsOf(value); }

double parseNumber(std::string_view text, const std::string& what, double low, double high) {
  return parse<double>(text, what, low, high);
}

Request::Request(std::string_view line) {
  if (!std::all_of(line.begin(), line.end(), isPrintable)) {
    fault_ = "a line has characters that are no printable ASCII";
    const std::string_view word = cutWord(line);
    if (isTag(word)) tag_ = word;
    return;
  }
  split(line);
}

void Request::split(std::string_view line) {
  std::string_view word = cutWord(line);
  if (word.starts_with('#')) {
    if (!isTag(word)) {
      fault_ = "found the tag '" + printable(word) + "', expected # and 1 to 32 of [A-Za-z0-9_-]";
      return;
    }
    tag_ = word;
    word = cutWord(line);
  }
  command_ = word.substr(0, 32);
  for (char& c : command_)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  rest_ = line;
  if (command_.empty()) fault_ = "the line has no command; HELP lists them";
  for (word = cutWord(line); !word.empty(); word = cutWord(line)) {
    if (words_.size() + keys_.size() == kMostArguments) {
      fault_ = "the line has more than " + std::to_string(kMostArguments) + " arguments";
      return;
    }
    if (const std::size_t length = keyLength(word); length > 0)
      keys_.emplace_back(word.substr(0, length), word.substr(length + 1));
    else
      words_.emplace_back(word);
  }
}

std::vector<std::string> Request::takeWords() { return std::exchange(words_, {}); }

std::map<std::string, std::string> Request::takeKeys() {
  std::map<std::string, std::string> keys;
  for (auto& [key, value] : std::exchange(keys_, {})) {
    const auto [entry, isNew] = keys.emplace(key, std::move(value));
    if (!isNew) refuse(command_ + " has " + entry->first + "= twice, expected it once");
  }
  return keys;
}

std::string Request::takeWord(const char* what) {
  if (words_.empty()) refuse(command_ + " needs " + what);
  std::string word = std::move(words_.front());
  words_.erase(words_.begin());
  return word;
}

std::optional<std::string> Request::takeText(std::string_view key) {
  const auto found = std::find_if(keys_.begin(), keys_.end(),
                                  [&](const auto& entry) { return entry.first == key; });
  if (found == keys_.end()) return std::nullopt;
  std::string value = std::move(found->second);
  keys_.erase(found);
  return value;
}

std::optional<double> Request::takeNumber(std::string_view key, double low, double high) {
  const auto text = takeText(key);
  if (!text) return std::nullopt;
  return parse<double>(*text, std::string(key), low, high);
}

std::optional<std::int64_t> Request::takeInteger(std::string_view key, std::int64_t low,
                                                 std::int64_t high) {
  const auto text = takeText(key);
  if (!text) return std::nullopt;
  return parse<std::int64_t>(*text, std::string(key), low, high);
}

std::optional<std::uint64_t> Request::takeSeed() {
  const auto text = takeText("seed");
  if (!text) return std::nullopt;
  return parse<std::uint64_t>(*text, "seed", 0, std::numeric_limits<std::uint64_t>::max());
}

std::optional<Pose2> Request::takePose() {
  constexpr double kFarthest = 1e6;  // [m]
  const auto x = takeNumber("x_m", -kFarthest, kFarthest);
  const auto y = takeNumber("y_m", -kFarthest, kFarthest);
  const auto degrees = takeNumber("theta_deg", -360.0, 360.0);
  const auto radians = takeNumber("theta_rad", -7.0, 7.0);  // for programs: no rounding
  if (!x && !y && !degrees && !radians) return std::nullopt;
  if (degrees && radians) refuse("a pose has theta_deg or theta_rad, not both");
  if (!x || !y) refuse("a pose needs x_m and y_m");
  return Pose2{*x, *y, wrapAngle(radians ? *radians : ortung::radians(degrees.value_or(0.0)))};
}

void Request::refuseRest() const {
  if (!words_.empty()) refuse(command_ + " does not know '" + printable(words_.front()) + "'");
  if (!keys_.empty()) refuse(command_ + " does not know '" + keys_.front().first + "='");
}

}  // namespace ortung::server
