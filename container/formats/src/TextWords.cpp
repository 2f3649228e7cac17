#include "TextWords.hpp"

#include <algorithm>
#include <stdexcept>

namespace ortung {
namespace {

constexpr std::size_t kBytesAWord = 4;
constexpr unsigned kBitsAByte = 8;
constexpr std::uint32_t kByte = 0xff;

}  // namespace

void addTextWords(std::string_view text, std::vector<std::uint32_t>& words) {
  words.push_back(static_cast<std::uint32_t>(text.size()));
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i % kBytesAWord == 0) words.push_back(0);
    words.back() |= std::uint32_t{static_cast<unsigned char>(text[i])}
                    << (kBitsAByte * (i % kBytesAWord));
  }
}

void checkText(const char* what, std::string_view text, std::size_t longest) {
  if (text.size() > longest)
    throw std::invalid_argument("found " + std::string(what) + " of " +
                                std::to_string(text.size()) + " characters, expected at most " +
                                std::to_string(longest));
  if (std::any_of(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }))
    throw std::invalid_argument("found " + std::string(what) + " that is not printable ASCII");
}

bool isName(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  constexpr std::string_view kOfNames =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-";
  return !text.empty() && text.size() <= kLongest &&
         text.find_first_not_of(kOfNames) == std::string_view::npos;
}

std::span<const std::uint32_t> WordsReader::take(std::size_t count) {
  if (count > rest_.size())
    throw std::invalid_argument("found " + std::to_string(rest_.size()) + " words where " +
                                std::to_string(count) + " were expected");
  const auto taken = rest_.first(count);
  rest_ = rest_.subspan(count);
  return taken;
}

std::string WordsReader::text(const char* what, std::size_t longest) {
  const std::uint32_t bytes = word();
  if (bytes > longest)
    throw std::invalid_argument("found " + std::string(what) + " of " + std::to_string(bytes) +
                                " characters, expected at most " + std::to_string(longest));
  const std::span<const std::uint32_t> packed = take((bytes + kBytesAWord - 1) / kBytesAWord);
  std::string text(packed.size() * kBytesAWord, '\0');
  for (std::size_t i = 0; i < text.size(); ++i)
    text[i] =
        static_cast<char>(packed[i / kBytesAWord] >> (kBitsAByte * (i % kBytesAWord)) & kByte);
  if (std::any_of(text.begin() + bytes, text.end(), [](char c) { return c != '\0'; }))
    throw std::invalid_argument("found " + std::string(what) +
                                " whose last word is not filled up "
                                "with 0");
  text.resize(bytes);
  checkText(what, text, longest);
  return text;
}

}  // namespace ortung
