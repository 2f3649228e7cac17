#include "ortung/core/ReadingLine.hpp"

#include <charconv>
#include <stdexcept>

namespace ortung {
namespace {

template <class Number>
void append(std::string& line, Number value) {
  char digits[24];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  line.append(digits, end);
}

/// Cuts the next token off @p rest; tokens are separated by exactly one blank.
std::string_view cutToken(std::string_view& rest) {
  const std::size_t blank = rest.find(' ');
  const std::string_view token = rest.substr(0, blank);
  rest = blank == rest.npos ? std::string_view() : rest.substr(blank + 1);
  return token;
}

template <class Number>
bool parseWhole(std::string_view token, Number& value) {
  const auto result = std::from_chars(token.data(), token.data() + token.size(), value);
  return result.ec == std::errc() && result.ptr == token.data() + token.size() && !token.empty();
}

std::optional<Message> refuse(std::string* why, std::string reason) {
  if (why != nullptr) *why = std::move(reason);
  return std::nullopt;
}

}  // namespace

std::string inQuotation(std::string_view token) {
  std::string text = "'";
  for (const char c : token.substr(0, 40)) text += (c >= 0x20 && c < 0x7F) ? c : '?';
  return text + (token.size() > 40 ? "...'" : "'");
}

void writeLine(const Message& message, std::string& line) {
  append(line, message.stamp);
  line += ' ';
  line += toText(message.id);
  line += ' ';
  append(line, message.words.size());
  for (const std::uint32_t word : message.words) {
    line += ' ';
    append(line, word);
  }
}

std::optional<Message> parseLine(std::string_view line, std::string* why) {
  Message message;
  if (line.ends_with(' ')) return refuse(why, "the line ends with a blank");
  const std::string_view stamp = cutToken(line);
  if (!parseWhole(stamp, message.stamp)) {
    return refuse(why, "found " + inQuotation(stamp) + ", expected a time stamp in microseconds");
  }
  const std::string_view id = cutToken(line);
  try {
    message.id = parseSensorId(id);
  } catch (const std::invalid_argument& error) {
    return refuse(why, "found " + inQuotation(id) + ": " + error.what());
  }
  const std::string_view countToken = cutToken(line);
  std::size_t count = 0;
  if (!parseWhole(countToken, count) || count > kMaxWords) {
    return refuse(why, "found " + inQuotation(countToken) + ", expected a number of words");
  }
  if (count > line.size()) {
    return refuse(why, "the line is torn: it announces " + std::to_string(count) + " words");
  }
  message.words.reserve(count);
  while (!line.empty()) {
    const std::string_view token = cutToken(line);
    std::uint32_t word = 0;
    if (!parseWhole(token, word)) {
      return refuse(why, "found " + inQuotation(token) + ", expected an unsigned 32-bit word");
    }
    message.words.push_back(word);
  }
  if (message.words.size() != count) {
    return refuse(why, "found " + std::to_string(message.words.size()) + " words, expected " +
                           std::to_string(count) + " as the line announces");
  }
  return message;
}

}  // namespace ortung
