#include "Token.hpp"

namespace ortung::server {

bool isSameInConstantTime(std::string_view secret, std::string_view given) {
  // volatile, so that no compiler ends the loop early.
  volatile unsigned char difference = secret.size() == given.size() ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const char expected = secret.empty() ? '\0' : secret[i % secret.size()];
    difference = static_cast<unsigned char>(difference | (expected ^ given[i]));
  }
  return difference == 0;
}

bool isTokenRight(const std::vector<BoardToken>& tokens, std::string_view name,
                  std::string_view given) {
  bool isRight = tokens.empty();
  for (const BoardToken& token : tokens) {
    const bool isSame = isSameInConstantTime(token.token, given);
    const bool isMeant = token.name == "*" || token.name == name;
    isRight = isRight || (isSame && isMeant && !token.token.empty());
  }
  return isRight;
}

}  // namespace ortung::server
