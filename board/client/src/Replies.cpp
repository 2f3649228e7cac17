#include "Replies.hpp"

#include <algorithm>

namespace ortung::client {

std::string_view cutWord(std::string_view& line) {
  const std::string_view word = line.substr(0, line.find(' '));
  line.remove_prefix(std::min(word.size() + 1, line.size()));
  return word;
}

std::string_view valueOf(std::string_view line, std::string_view key) {
  while (!line.empty()) {
    const std::string_view word = cutWord(line);
    if (word.size() > key.size() && word.starts_with(key) && word[key.size()] == '=')
      return word.substr(key.size() + 1);
  }
  return {};
}

}  // namespace ortung::client
