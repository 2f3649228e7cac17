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

/// A reply or event of the message board: a line, and the lines or bytes that follow it.
struct BoardReply {
  std::vector<std::string> words;  ///< words of its line without those with =: "OK", "LIST", ...
  std::map<std::string, std::string> keys;  ///< values of its line by key
  std::vector<std::string> lines;           ///< lines that follow
  std::string bytes;                        ///< bytes that follow
  /// Whether the request was granted.
  bool isOk() const { return !words.empty() && words[0] == "OK"; }
  /// Returns a finite number of the line, if the key has one.
  std::optional<double> real(const std::string& key) const;
  std::string text() const;  ///< its words, separated by blanks
  /// Returns a whole number of the line, or @p fallback.
  std::int64_t number(const std::string& key, std::int64_t fallback) const;
};

/// Parses the words and keys of a line.
BoardReply parseBoardLine(std::string_view line);

/// A client's side of the board's protocol: requests and their replies, and events.
/// Not thread-safe.
class BoardReplies {
 public:
  using Handler = std::function<void(const BoardReply&)>;
  /// @param unasked gets the events, whose lines begin with '*'
  explicit BoardReplies(Handler unasked) : unasked_(std::move(unasked)) {}

  /// Appends a request to @p out. @param handler gets the reply
  void ask(std::string_view request, Handler handler, std::string& out);
  /// Takes bytes of the board, cut anywhere. @returns false if they violate the protocol
  bool take(std::string_view bytes);

 private:
  bool takeLine(std::string_view line);
  void finish();

  Handler unasked_;
  std::deque<Handler> asked_;
  std::string rest_;  ///< begin of an incomplete line
  BoardReply reply_;  ///< reply whose lines or bytes are not complete
  std::size_t linesLeft_ = 0;
  std::size_t bytesLeft_ = 0;
};

}  // namespace ortung::foxglove
