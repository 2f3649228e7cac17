#include "ortung/core/BinaryReading.hpp"

#include <bit>
#include <charconv>
#include <cstring>

#include "ortung/core/ReadingLine.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBytesAWord = 4;

std::optional<Message> refuse(std::string* why, const char* reason) {
  if (why != nullptr) *why = reason;
  return std::nullopt;
}

}  // namespace

void writeBinary(const Message& message, std::string& out) {
  out += std::to_string(message.stamp) + ' ' + toText(message.id) + ' ' +
         std::to_string(message.words.size()) + '\n';
  std::size_t next = out.size();
  out.resize(next + kBytesAWord * message.words.size());
  if constexpr (std::endian::native == std::endian::little) {
    if (!message.words.empty())
      std::memcpy(out.data() + next, message.words.data(), kBytesAWord * message.words.size());
  } else {
    for (const std::uint32_t word : message.words)
      for (int shift = 0; shift < 32; shift += 8)
        out[next++] = static_cast<char>(word >> shift & 0xFF);
  }
}

std::optional<Message> parseBinary(std::string_view& bytes, std::string* why) {
  const std::string_view head = bytes.substr(0, bytes.find('\n'));
  if (head.size() == bytes.size()) return refuse(why, "the reading is torn: its line does not end");
  const std::size_t blank = head.find(' ', head.find(' ') + 1);
  if (blank == head.npos) return refuse(why, "found a line of less than three words");
  // The head is that of a reading as text, but the words follow.
  std::optional<Message> message = parseLine(std::string(head.substr(0, blank)) + " 0", why);
  if (!message) return message;
  const std::string_view number = head.substr(blank + 1);
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  if (number.empty() || error != std::errc() || end != number.data() + number.size() ||
      count > kMaxWords)
    return refuse(why, "the number of words is none");
  const std::string_view rest = bytes.substr(head.size() + 1);
  if (rest.size() < kBytesAWord * count)
    return refuse(why, "the reading is torn: words are missing");
  message->words.resize(count);
  for (std::size_t i = 0; i < kBytesAWord * count; ++i)
    message->words[i / kBytesAWord] |= std::uint32_t{static_cast<unsigned char>(rest[i])}
                                       << 8 * (i % kBytesAWord);
  bytes = rest.substr(kBytesAWord * count);
  return message;
}

}  // namespace ortung
