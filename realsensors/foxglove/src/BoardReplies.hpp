#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ortung::foxglove {

/// One thing that the message board says: a line, and the lines or bytes that belong to it.
struct BoardReply {
  std::vector<std::string> words;  ///< of its line: "OK", "LIST", ...; without those with =
  std::map<std::string, std::string> keys;  ///< of its line
  std::vector<std::string> lines;
  std::string bytes;
  bool isOk() const { return !words.empty() && words[0] == "OK"; }
  /// A finite number of the line, if it has one.
  std::optional<double> real(const std::string& key) const;
  std::string text() const;  ///< its words in a row
  /// A whole number of the line, or @p fallback.
  std::int64_t number(const std::string& key, std::int64_t fallback) const;
};

/// The words and keys of a line.
BoardReply parseBoardLine(std::string_view line);

/// A client's side of the board's protocol: requests and their replies, and what comes unasked.
/// Not thread-safe.
class BoardReplies {
 public:
  using Handler = std::function<void(const BoardReply&)>;
  /// @param unasked gets what begins with '*'
  explicit BoardReplies(Handler unasked) : unasked_(std::move(unasked)) {}

  /// Appends a request to @p out. @param handler gets its reply
  void ask(std::string_view request, Handler handler, std::string& out);
  /// @returns false if these can't be the board's words
  bool take(std::string_view bytes);

 private:
  bool takeLine(std::string_view line);
  void finish();

  Handler unasked_;
  std::deque<Handler> asked_;
  std::string rest_;  ///< not whole yet
  BoardReply reply_;  ///< whose lines or bytes are still to come
  std::size_t linesLeft_ = 0;
  std::size_t bytesLeft_ = 0;
};

}  // namespace ortung::foxglove
