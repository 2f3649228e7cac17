#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ortung {

/// Texts as words: the number of bytes, and the bytes, four a word, the first one lowest, the last
/// word filled up with 0.
void addTextWords(std::string_view text, std::vector<std::uint32_t>& words);

/// Takes words from their beginning. Whatever is missing or wrong is thrown as
/// std::invalid_argument.
class WordsReader {
 public:
  explicit WordsReader(std::span<const std::uint32_t> words) : rest_(words) {}

  bool isAtEnd() const { return rest_.empty(); }
  std::uint32_t word() { return take(1).front(); }
  std::span<const std::uint32_t> take(std::size_t count);
  /// Printable ASCII. @param what e.g. "a name"
  std::string text(const char* what, std::size_t longest);

 private:
  std::span<const std::uint32_t> rest_;
};

/// @throws std::invalid_argument unless it is printable ASCII and no longer than that
void checkText(const char* what, std::string_view text, std::size_t longest);

/// Whether something can be called so: 1 to 64 characters of [A-Za-z0-9_.-].
bool isName(std::string_view text);

}  // namespace ortung
