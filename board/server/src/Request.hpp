#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ortung/base/Pose2.hpp"

namespace ortung::server {

/// One line of a client, taken apart: "[#TAG] COMMAND [word ...] [key=value ...]".
/// Questions about its arguments throw ServeError; what nobody asked for is refused at the end.
class Request {
 public:
  /// @param line without its end. @throws ServeError("syntax", ...); the tag is still known then
  explicit Request(std::string_view line);

  const std::string& tag() const { return tag_; }          ///< "#7", or ""
  const std::string& command() const { return command_; }  ///< the first word, in capitals
  /// Everything behind the command, as it came.
  const std::string& rest() const { return rest_; }
  /// What is wrong with the line, or "".
  const std::string& fault() const { return fault_; }

  std::vector<std::string> takeWords();
  /// All that is left of key=value, each key once.
  std::map<std::string, std::string> takeKeys();
  /// The next word. @param what what the error calls it
  std::string takeWord(const char* what);
  std::optional<std::string> takeText(std::string_view key);
  std::optional<double> takeNumber(std::string_view key, double low, double high);
  std::optional<std::int64_t> takeInteger(std::string_view key, std::int64_t low,
                                          std::int64_t high);
  std::optional<std::uint64_t> takeSeed();
  /// x_m, y_m and theta_deg or theta_rad, 0 if both are missing; nothing if none is there.
  std::optional<Pose2> takePose();
  void refuseRest() const;

 private:
  void split(std::string_view line);
  std::string tag_;
  std::string command_;
  std::string rest_;
  std::string fault_;
  std::vector<std::string> words_;
  std::vector<std::pair<std::string, std::string>> keys_;
};

/// A finite number within bounds. @throws ServeError naming @p what, what was found and expected
double parseNumber(std::string_view text, const std::string& what, double low, double high);

/// @p text with everything that could do harm to a terminal replaced by '?'.
std::string printable(std::string_view text, std::size_t mostCharacters = 200);

/// Of a line that describes something [characters].
constexpr std::size_t kLongestDescription = 1000;

/// The same as one word: '_' for blanks.
std::string oneWord(std::string_view text);

/// The shortest text that gives the same number again.
std::string shown(double value);

/// Whether @p name is of [A-Za-z0-9_-], 1 to 32 characters.
bool isName(std::string_view name);

}  // namespace ortung::server
