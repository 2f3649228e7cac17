#include "Output.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

namespace ortung::server {

static_assert(std::endian::native == std::endian::little,
              "words go as they lie in memory, the least significant byte first");

std::string_view Output::Piece::bytes() const {
  if (!reading) return text;
  return {reinterpret_cast<const char*>(reading->words.data()),
          sizeof(std::uint32_t) * reading->words.size()};
}

std::string& Output::text() {
  if (pieces_.empty() || pieces_.back().reading || isLooked_) {
    pieces_.emplace_back();
    isLooked_ = false;
  }
  return pieces_.back().text;
}

void Output::add(std::shared_ptr<const Message> reading) {
  text() += std::to_string(reading->stamp) + ' ' + toText(reading->id) + ' ' +
            std::to_string(reading->words.size()) + '\n';
  pieces_.push_back({"", std::move(reading)});
}

void Output::add(Output&& more) {
  for (Piece& piece : more.pieces_) {
    if (piece.reading) {
      pieces_.push_back(std::move(piece));
    } else {
      text() += piece.text;
    }
  }
  more.pieces_.clear();
}

std::size_t Output::size() const {
  std::size_t size = 0;
  for (const Piece& piece : pieces_) size += piece.bytes().size();
  return size - taken_;
}

std::size_t Output::readingBytes() const {
  std::size_t size = 0;
  for (const Piece& piece : pieces_) size += piece.reading ? piece.bytes().size() : 0;
  return size;
}

void Output::look(std::size_t most, std::vector<std::string_view>& pieces) {
  std::size_t skip = taken_;
  for (const Piece& piece : pieces_) {
    const std::string_view bytes = piece.bytes().substr(skip, most);
    skip = 0;
    most -= bytes.size();
    if (!bytes.empty()) pieces.push_back(bytes);
    if (most == 0) break;
  }
  isLooked_ = true;
}

void Output::take(std::size_t bytes) {
  taken_ += bytes;
  while (!pieces_.empty() && taken_ >= pieces_.front().bytes().size()) {
    taken_ -= pieces_.front().bytes().size();
    pieces_.pop_front();
  }
  isLooked_ = false;
}

}  // namespace ortung::server
