#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "Chunk.hpp"
#include "ChunkTags.hpp"
#include "RecordReader.hpp"

namespace ortung {
namespace {

/// Reads a record of compressed chunks.
class ChunkRecord final : public RecordReader {
 public:
  ChunkRecord(const std::filesystem::path& file, std::ifstream in);
  bool next(Message& message) override;
  void seek(Timestamp from) override;
  double progress() const override;
  bool isFile() const override { return frames_.isFile(); }
  std::string remark() const override;

 private:
  bool open();
  bool cutLine(std::string_view& line);
  bool readApart(std::string_view note, Message& message);
  void take(const Message& message);
  void close();
  chunk::Place placeBefore(Timestamp from);
  std::string where() const;

  std::filesystem::path file_;
  chunk::Frames frames_;
  bool isOpen_ = false;    ///< whether a chunk is being read
  chunk::Head head_;       ///< head of the open chunk
  std::string lines_;      ///< lines of the open chunk
  std::size_t begin_ = 0;  ///< offset of the next line in lines_
  std::size_t line_ = 0;   ///< number of the last line
  std::uint64_t end_ = 0;  ///< end of the chunk in the file [bytes]
  std::uint32_t readings_ = 0;
  std::uint32_t apart_ = 0;
  Timestamp last_ = std::numeric_limits<Timestamp>::min();
};

ChunkRecord::ChunkRecord(const std::filesystem::path& file, std::ifstream in)
    : file_(file), frames_(file, std::move(in)) {
  isOpen_ = open();
  const std::string_view lines = lines_;
  for (std::string_view line; isOpen_ && lines.substr(begin_).starts_with('#') &&
                              !lines.substr(begin_).starts_with(chunk::kApartNote);) {
    cutLine(line);
    takeNote(line);
  }
}

std::string ChunkRecord::where() const {
  return file_.string() + ": line " + std::to_string(line_) + " of the chunk at byte " +
         std::to_string(frames_.chunkBegin()) + ": ";
}

/// Opens the next chunk; returns false if there is none.
bool ChunkRecord::open() {
  const auto head = frames_.head();
  if (!head || !frames_.isWhole(*head) || !frames_.text(*head, lines_)) return false;
  head_ = *head;
  end_ = frames_.offset() + head_.apartBytes;
  begin_ = line_ = 0;
  readings_ = apart_ = 0;
  return true;
}

bool ChunkRecord::cutLine(std::string_view& line) {
  if (begin_ >= lines_.size()) return false;
  const std::size_t end = lines_.find('\n', begin_);
  ++line_;
  if (end == std::string::npos) throw std::runtime_error(where() + "found no end of it");
  line = std::string_view(lines_).substr(begin_, end - begin_);
  begin_ = end + 1;
  return true;
}

/// Cuts off the number behind the last blank; nothing if there is none.
template <class Number>
std::optional<Number> cutNumber(std::string_view& text) {
  const std::size_t blank = text.rfind(' ');
  if (blank == text.npos) return std::nullopt;
  Number number = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + blank + 1, end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  text.remove_suffix(text.size() - blank);
  return number;
}

/// Reads the reading of a line "# binary STAMP ID WORDS STRIDE", whose words are behind the lines.
bool ChunkRecord::readApart(std::string_view note, Message& message) {
  const auto stride = cutNumber<std::uint32_t>(note);
  const auto words = cutNumber<std::size_t>(note);
  std::string why = "announces no reading that can be there";
  const bool isGood = stride && words && *words > 0 && *words <= kMaxWords &&
                      chunk::isStride(*stride) && ++apart_ <= head_.apart;
  auto parsed = isGood ? parseLine(std::string(note) + " 0", &why) : std::nullopt;
  if (!parsed) throw std::runtime_error(where() + why);
  if (!frames_.apart(*words, *stride, parsed->words)) return false;
  message = std::move(*parsed);
  return true;
}

void ChunkRecord::take(const Message& message) {
  checkOrder(where(), last_, message.stamp);
  if (message.stamp < head_.first || message.stamp > head_.last)
    throw std::runtime_error(where() + "found a time stamp that is not of this chunk");
  last_ = message.stamp;
  ++readings_;
}

void ChunkRecord::close() {
  if (readings_ != head_.readings || apart_ != head_.apart || frames_.offset() != end_)
    frames_.fail("does not hold as much as its head says");
}

bool ChunkRecord::next(Message& message) {
  for (std::string_view line;;) {
    if (!isOpen_) return false;
    if (!cutLine(line)) {
      close();
      isOpen_ = open();
      continue;
    }
    if (line.starts_with(chunk::kApartNote)) {
      if (!readApart(line.substr(chunk::kApartNote.size()), message)) return false;
    } else if (line.starts_with('#')) {
      continue;
    } else {
      std::string why;
      auto parsed = parseLine(line, &why);
      if (!parsed) throw std::runtime_error(where() + why);
      message = std::move(*parsed);
    }
    take(message);
    return true;
  }
}

/// Returns the last chunk that begins before that time, or the first one.
chunk::Place ChunkRecord::placeBefore(Timestamp from) {
  chunk::Place place{chunk::magic().size(), 0};
  if (const auto index = frames_.index()) {
    for (const chunk::Place& one : *index)
      if (one.first < from) place = one;
    return place;
  }
  frames_.jump(place.offset);
  while (const auto head = frames_.head()) {
    if (head->readings > 0 && head->first >= from) break;
    if (head->readings > 0) place = {frames_.chunkBegin(), head->first};
    if (!frames_.skip(head->packedBytes + head->apartBytes)) break;
  }
  return place;
}

void ChunkRecord::seek(Timestamp from) {
  if (!frames_.isFile()) return;
  const chunk::Place place = placeBefore(from);
  frames_.jump(place.offset);
  last_ = std::numeric_limits<Timestamp>::min();
  isOpen_ = open();
  if (isOpen_ && place.offset != chunk::magic().size() && head_.first != place.first)
    frames_.fail("is not the one that the index names");
}

double ChunkRecord::progress() const {
  const std::uint64_t whole = frames_.torn() ? frames_.torn()->begin : frames_.size();
  if (!frames_.isFile() || whole == 0) return -1.0;
  if (frames_.torn()) return 1.0;
  auto done = static_cast<double>(frames_.offset());
  if (isOpen_ && head_.readings > 0) {
    // A short log is a single chunk, which is read at once: what counts are its readings.
    const auto begin = static_cast<double>(frames_.chunkBegin());
    done = begin + (static_cast<double>(end_) - begin) * static_cast<double>(readings_) /
                       static_cast<double>(head_.readings);
  }
  return std::min(1.0, done / static_cast<double>(whole));
}

std::string ChunkRecord::remark() const {
  return frames_.torn() ? tornRemark(file_, frames_.torn()->bytes) : "";
}

}  // namespace

std::unique_ptr<RecordReader> readChunks(const std::filesystem::path& file, std::ifstream in) {
  return std::make_unique<ChunkRecord>(file, std::move(in));
}

}  // namespace ortung
