#include "ortung/core/Format.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "ortung/base/Angles.hpp"
#include "ortung/core/ReadingLine.hpp"

namespace ortung {
namespace {

bool isWord(std::string_view text) {
  return !text.empty() && text.size() <= Format::kLongestName &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

void checkWord(const char* what, std::string_view text) {
  if (!isWord(text))
    throw std::invalid_argument("found the format's " + std::string(what) + " " +
                                inQuotation(text) + ", expected 1 to 64 of [a-z0-9_]");
}

void checkValue(const std::string& key, std::string_view value) {
  if (value.empty() ||
      !std::all_of(value.begin(), value.end(), [](char c) { return c > 0x20 && c < 0x7F; }))
    throw std::invalid_argument("found the format's " + key + "=" + inQuotation(value) +
                                ", expected printable characters without blanks");
}

/// Returns the number's shortest text, or one with @p digits digits.
std::string numberText(double value, std::optional<int> digits = {}) {
  char text[32];
  const auto end =
      digits ? std::to_chars(text, text + sizeof text, value, std::chars_format::general, *digits)
             : std::to_chars(text, text + sizeof text, value);
  return {text, end.ptr};
}

std::optional<double> readNumber(std::string_view text) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// Cuts off the part before the next @p separator.
std::string_view cut(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view part = rest.substr(0, end);
  rest = end == rest.npos ? std::string_view() : rest.substr(end + 1);
  return part;
}

std::invalid_argument missing(const Format& format, std::string_view key, const char* what) {
  return std::invalid_argument("the format '" + format.name() + "' has no " + what + " '" +
                               std::string(key) + "'");
}

}  // namespace

Format::Format(std::string name) : name_(std::move(name)) { checkWord("name", name_); }

Format& Format::with(const std::string& key, const std::string& value) {
  checkWord("key", key);
  checkValue(key, value);
  if (has(key)) throw std::invalid_argument("the format's parameter '" + key + "' is there twice");
  if (parameters_.size() == kMostParameters)
    throw std::invalid_argument("found more than 32 parameters of a format");
  if (toText().size() + key.size() + value.size() + 2 > kLongestText)
    throw std::invalid_argument("found a format of more than 900 characters");
  parameters_.emplace_back(key, value);
  return *this;
}

Format& Format::with(const std::string& key, double value) {
  if (!std::isfinite(value))
    throw std::invalid_argument("the format's parameter '" + key + "' is not finite");
  return with(key, numberText(value));
}

Format& Format::withAngle(const std::string& key, double angle) {
  // Converting to degrees and back rounds twice, so not all digits of a double are needed.
  constexpr int kDigits = 17;
  for (int digits = 1; digits <= kDigits; ++digits) {
    const auto rounded = readNumber(numberText(degrees(angle), digits));
    if (rounded && radians(*rounded) == angle) return with(key, *rounded);
  }
  return with(key, degrees(angle));
}

Format& Format::with(const std::string& key, std::span<const char* const> values) {
  std::string text;
  for (const char* value : values) {
    std::string one = value;
    for (char& c : one)
      if (c == ' ' || c == ',') c = '_';
    text += (text.empty() ? "" : ",") + one;
  }
  return with(key, text);
}

const std::string* Format::find(std::string_view key) const {
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const Parameter& p) { return p.first == key; });
  return found == parameters_.end() ? nullptr : &found->second;
}

bool Format::has(std::string_view key) const { return find(key) != nullptr; }

const std::string& Format::text(std::string_view key) const {
  const std::string* value = find(key);
  if (value == nullptr) throw missing(*this, key, "parameter");
  return *value;
}

double Format::number(std::string_view key) const {
  const auto value = readNumber(text(key));
  if (!value) throw missing(*this, key, "number");
  return *value;
}

double Format::angle(std::string_view key) const { return radians(number(key)); }

std::vector<std::string> Format::list(std::string_view key) const {
  std::string_view rest = text(key);
  std::vector<std::string> parts;
  const auto commas = std::count(rest.begin(), rest.end(), ',');
  for (std::ptrdiff_t i = 0; i <= commas; ++i) parts.emplace_back(cut(rest, ','));
  return parts;
}

std::string Format::toText() const {
  std::string text = name_;
  for (const auto& [key, value] : parameters_) text += " " + key + "=" + value;
  return text;
}

Format parseFormat(std::string_view text) {
  if (text.size() > Format::kLongestText)
    throw std::invalid_argument("found a format of more than 900 characters");
  if (text.ends_with(' ')) throw std::invalid_argument("a format's text ends with a blank");
  Format format{std::string(cut(text, ' '))};
  while (!text.empty()) {
    std::string_view value = cut(text, ' ');
    if (value.find('=') == value.npos)
      throw std::invalid_argument("found " + inQuotation(value) +
                                  " in a format, expected KEY=VALUE");
    const std::string_view key = cut(value, '=');
    format.with(std::string(key), std::string(value));
  }
  return format;
}

}  // namespace ortung
