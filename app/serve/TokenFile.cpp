#include "TokenFile.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "ortung/base/InputFile.hpp"

namespace ortung::app {

std::vector<BoardToken> readTokens(const std::filesystem::path& file) {
  std::vector<BoardToken> tokens;
  if (file.empty()) return tokens;
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) throw std::runtime_error(file.string() + ": " + why);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    BoardToken token;
    if (!(words >> token.name) || token.name.starts_with('#')) continue;
    std::string more;
    if (!(words >> token.token) || (words >> more) || token.token.size() < 8)
      throw std::runtime_error(fmt::format(
          "{}:{}: expected a client's name (or *) and its token of at least 8 characters",
          file.string(), number));
    tokens.push_back(token);
  }
  if (tokens.empty()) throw std::runtime_error(file.string() + ": has no tokens");
  return tokens;
}

}  // namespace ortung::app
