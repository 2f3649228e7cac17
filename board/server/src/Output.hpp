#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/core/Message.hpp"

namespace ortung::server {

/// Bytes on their way to a client: text, and readings whose words are sent as they lie in memory,
/// shared with whoever else sends them. Not thread-safe.
class Output {
 public:
  /// To be appended to.
  std::string& text();
  /// Appends a reading in binary form.
  void add(std::shared_ptr<const Message> reading);
  void add(std::string_view more) { text() += more; }
  void add(Output&& more);

  std::size_t size() const;          ///< [bytes]
  std::size_t readingBytes() const;  ///< words of readings in it [bytes]
  bool isEmpty() const { return size() == 0; }

  /// Appends the first bytes, @p most at most, in pieces that stay where they are until take().
  void look(std::size_t most, std::vector<std::string_view>& pieces);
  /// The first bytes are gone.
  void take(std::size_t bytes);

 private:
  struct Piece {
    std::string text;
    std::shared_ptr<const Message> reading;  ///< null: it is the text
    std::string_view bytes() const;
  };
  std::list<Piece> pieces_;  ///< none is empty, but maybe the last
  std::size_t taken_ = 0;    ///< bytes of the first piece that were taken
  bool isLooked_ = false;    ///< what is there must stay where it is
};

}  // namespace ortung::server
