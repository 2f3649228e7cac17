#include "BoardReplies.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ortung::foxglove {
namespace {

constexpr std::size_t kLongestLine = 1U << 20;
constexpr std::int64_t kMostLines = 1 << 20;
constexpr std::int64_t kMostBytes = 1 << 28;

}  // namespace

std::optional<double> BoardReply::real(const std::string& key) const {
  const auto found = keys.find(key);
  if (found == keys.end()) return std::nullopt;
  const char* const end = found->second.data() + found->second.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(found->second.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string BoardReply::text() const {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::int64_t BoardReply::number(const std::string& key, std::int64_t fallback) const {
  const auto found = keys.find(key);
  if (found == keys.end()) return fallback;
  const char* const end = found->second.data() + found->second.size();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(found->second.data(), end, value);
  return error == std::errc() && stop == end ? value : fallback;
}

BoardReply parseBoardLine(std::string_view line) {
  BoardReply reply;
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find(' '));
    line.remove_prefix(std::min(word.size() + 1, line.size()));
    if (word.empty()) continue;
    const std::size_t equals = word.find('=');
    if (equals == word.npos || equals == 0)
      reply.words.emplace_back(word);
    else
      reply.keys.emplace(word.substr(0, equals), word.substr(equals + 1));
  }
  return reply;
}

void BoardReplies::ask(std::string_view request, Handler handler, std::string& out) {
  out += request;
  out += '\n';
  asked_.push_back(std::move(handler));
}

void BoardReplies::finish() {
  const BoardReply reply = std::move(reply_);
  reply_ = {};
  if (reply.words.empty()) return;
  if (reply.words[0] == "*") return unasked_(reply);
  if (asked_.empty()) return;
  const Handler handler = std::move(asked_.front());
  asked_.pop_front();
  handler(reply);
}

bool BoardReplies::takeLine(std::string_view line) {
  if (linesLeft_ > 0) {
    reply_.lines.emplace_back(line);
    if (--linesLeft_ == 0) finish();
    return true;
  }
  reply_ = parseBoardLine(line);
  const std::int64_t lines = reply_.number("lines", 0);
  const std::int64_t bytes = reply_.number("bytes", 0);
  if (lines < 0 || lines > kMostLines || bytes < 0 || bytes > kMostBytes) return false;
  linesLeft_ = static_cast<std::size_t>(lines);
  bytesLeft_ = static_cast<std::size_t>(bytes);
  if (linesLeft_ == 0 && bytesLeft_ == 0) finish();
  return true;
}

bool BoardReplies::take(std::string_view bytes) {
  while (!bytes.empty()) {
    if (bytesLeft_ > 0) {
      const std::size_t count = std::min(bytesLeft_, bytes.size());
      reply_.bytes += bytes.substr(0, count);
      bytes.remove_prefix(count);
      bytesLeft_ -= count;
      if (bytesLeft_ == 0) finish();
      continue;
    }
    const std::size_t end = bytes.find('\n');
    rest_ += bytes.substr(0, end);
    if (rest_.size() > kLongestLine) return false;
    if (end == bytes.npos) return true;
    bytes.remove_prefix(end + 1);
    const std::string line = std::move(rest_);
    rest_.clear();
    if (!takeLine(line)) return false;
  }
  return true;
}

}  // namespace ortung::foxglove
