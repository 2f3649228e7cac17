#include "ortung/records/RecordEnd.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "Chunk.hpp"
#include "ortung/base/InputFile.hpp"
#include "ortung/core/ReadingLine.hpp"

// The writer of lines writes a time step in one piece, so a killed writer leaves a torn time step.
// Its whole lines are left out, too: it is unknown how many are missing.

namespace ortung {
namespace {

constexpr std::uintmax_t kSmallestChunk = 256;
constexpr std::uintmax_t kLargestChunk = 1u << 20;
constexpr std::uintmax_t kLongestStamp = 24;
constexpr int kMostLines = 65536;  ///< most lines of one time step, as FrameReader takes them

/// A file read from its end.
class Backwards {
 public:
  explicit Backwards(const std::filesystem::path& file) : file_(file) {
    std::string why;
    in_ = openInput(file, why);
    if (!in_) throw std::runtime_error(file.string() + ": " + why);
    size_ = std::filesystem::file_size(file);
  }
  std::uintmax_t size() const { return size_; }

  /// Returns the bytes in [begin, begin + count), as far as there are any.
  std::string bytes(std::uintmax_t begin, std::uintmax_t count) {
    std::string text(static_cast<std::size_t>(std::min(count, size_ - std::min(begin, size_))), 0);
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(begin));
    in_.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!in_) throw std::runtime_error(file_.string() + ": reading failed");
    return text;
  }

  /// Returns where the line begins that ends before @p end, its own end of line not counted; for a
  /// line that is too long to be read, some place within it.
  std::uintmax_t beginOfLine(std::uintmax_t end) {
    std::uintmax_t chunk = kSmallestChunk;
    const std::uintmax_t enough = end - std::min<std::uintmax_t>(end, kMaxLineBytes + 1);
    while (end > enough) {
      const std::uintmax_t count = std::min(chunk, end);
      chunk = std::min(4 * chunk, kLargestChunk);
      const std::size_t at = bytes(end - count, count).rfind('\n');
      if (at != std::string::npos) return end - count + at + 1;
      end -= count;
    }
    return end;
  }

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::uintmax_t size_ = 0;
};

/// Returns the time stamp at a line's begin, with the blank behind it if that is there.
std::string stampOf(const std::string& line) {
  const std::size_t blank = line.find(' ');
  return line.substr(0, blank == std::string::npos ? blank : blank + 1);
}

std::optional<TornRecord> tornChunk(const std::filesystem::path& path, std::ifstream in) {
  chunk::Frames frames(path, std::move(in));
  while (const auto head = frames.head())
    if (!frames.skip(head->packedBytes + head->apartBytes)) break;
  return frames.torn();
}

std::optional<TornRecord> tornLine(const std::filesystem::path& path) {
  Backwards file(path);
  const std::uintmax_t size = file.size();
  if (size == 0 || file.bytes(size - 1, 1) == "\n") return std::nullopt;
  std::uintmax_t begin = file.beginOfLine(size);
  if (size - begin > kMaxLineBytes) return std::nullopt;  // too long: the reader refuses it
  std::string stamp = stampOf(file.bytes(begin, std::min(size - begin, kLongestStamp)));
  std::uintmax_t end = begin;
  for (int i = 0; i < kMostLines && end > 0; ++i) {
    const std::uintmax_t lineBegin = file.beginOfLine(end - 1);
    const std::string line = file.bytes(lineBegin, std::min(end - lineBegin, kLongestStamp));
    end = lineBegin;
    if (line.starts_with('#') && lineBegin > 0) continue;
    if (line.starts_with('#') || !line.starts_with(stamp)) break;
    stamp = stampOf(line);  // the whole stamp, if it was torn before
    begin = lineBegin;
  }
  return TornRecord{begin, size - begin};
}

}  // namespace

std::optional<TornRecord> tornEnd(const std::filesystem::path& path) {
  std::string why;
  std::ifstream in = openInput(path, why);
  if (!in) throw std::runtime_error(path.string() + ": " + why);
  return chunk::begins(path, in) ? tornChunk(path, std::move(in)) : tornLine(path);
}

std::optional<TornRecord> mendRecord(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& why) -> std::runtime_error {
    return std::runtime_error(file.string() + ": can't be mended: " + why);
  };
  if (!tornEnd(file)) return std::nullopt;
  const int record = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (record < 0) throw fail(std::generic_category().message(errno));
  // A NewFile holds this lock as long as it is open.
  int error = ::flock(record, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
  std::optional<TornRecord> torn;
  if (error == 0) torn = tornEnd(file);  // there is no writer any more
  if (torn && (::ftruncate(record, static_cast<off_t>(torn->begin)) != 0 || ::fsync(record) != 0))
    error = errno;
  ::close(record);
  if (error == EWOULDBLOCK) throw fail("it is still being recorded");
  if (error != 0) throw fail(std::generic_category().message(error));
  return torn;
}

}  // namespace ortung
