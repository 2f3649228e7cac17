#include <algorithm>
#include <cerrno>
#include <limits>
#include <optional>
#include <stdexcept>

#include "RecordReader.hpp"
#include "ortung/base/FileKind.hpp"
#include "ortung/base/InputFile.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/records/RecordEnd.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung {
namespace {

/// Reads like std::getline, but gives up on a line longer than kMaxLineBytes, so that no file can
/// exhaust the memory: then the line is longer than that, and the stream stays where it is.
bool readLine(std::istream& in, std::string& line) {
  line.clear();
  char piece[4096];
  while (line.size() <= kMaxLineBytes) {
    in.getline(piece, sizeof piece);
    const auto count = static_cast<std::size_t>(in.gcount());
    const bool filled =
        in.fail() && !in.eof() && !in.bad() && count > 0;  // the piece has no end of line
    const bool ended = !in.fail() && !in.eof();            // the end of line counts, too
    line.append(piece, ended ? count - 1 : count);
    if (!filled) return !line.empty() || ended;
    in.clear(in.rdstate() & ~std::ios::failbit);
  }
  return true;
}

/// Reads a record of text lines.
class TextRecord final : public RecordReader {
 public:
  TextRecord(std::filesystem::path file, std::ifstream in);
  bool next(Message& message) override;
  void seek(Timestamp) override {}
  double progress() const override;
  bool isFile() const override { return isFile_; }
  std::string remark() const override;

 private:
  bool readWholeLine();
  std::string where() const { return file_.string() + ":" + std::to_string(lineNumber_) + ": "; }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(where() + what);
  }

  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  std::size_t lineNumber_ = 0;
  bool isFile_ = false;
  std::uintmax_t size_ = 0;  ///< size of a file when it was opened [bytes]
  std::uintmax_t done_ = 0;
  std::optional<TornRecord> torn_;
  Timestamp last_ = std::numeric_limits<Timestamp>::min();
};

TextRecord::TextRecord(std::filesystem::path file, std::ifstream in)
    : file_(std::move(file)), in_(std::move(in)) {
  isFile_ = std::filesystem::is_regular_file(file_);
  if (isFile_) {
    size_ = std::filesystem::file_size(file_);
    torn_ = tornEnd(file_);
  }
  const std::string expected = std::string(kRecordMagic) + "\n";
  std::string magic(expected.size(), 0);
  in_.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (in_.bad()) throw std::runtime_error(file_.string() + ": " + cantBeRead(errno));
  magic.resize(static_cast<std::size_t>(in_.gcount()));
  if (magic != expected)
    throw std::runtime_error(file_.string() + ":1: found " +
                             inQuotation(magic.substr(0, magic.find('\n'))) + ", expected '" +
                             std::string(kRecordMagic) + "' or a compressed record" +
                             whatItIs(file_, {FileKind::kRecord}));
  lineNumber_ = 1;
  done_ = magic.size();
  while (in_.peek() == '#' && readWholeLine()) takeNote(line_);
}

/// Reads the next line; returns false at the end of the whole ones.
bool TextRecord::readWholeLine() {
  if (torn_ && done_ >= torn_->begin) return false;
  const bool isLine = readLine(in_, line_);
  if (in_.bad() || line_.size() > kMaxLineBytes) {
    ++lineNumber_;
    fail(in_.bad() ? cantBeRead(errno) : "the line is longer than 64 MiB");
  }
  if (!isLine) return false;
  if (in_.eof()) {
    torn_ = {done_, line_.size()};
    return false;
  }
  ++lineNumber_;
  done_ += line_.size() + 1;
  return true;
}

bool TextRecord::next(Message& message) {
  while (readWholeLine()) {
    if (line_.starts_with('#')) continue;
    std::string why;
    auto parsed = parseLine(line_, &why);
    if (!parsed) fail(why);
    checkOrder(where(), last_, parsed->stamp);
    last_ = parsed->stamp;
    message = std::move(*parsed);
    return true;
  }
  if (in_.bad()) fail("reading failed");
  return false;
}

double TextRecord::progress() const {
  const auto whole = static_cast<double>(torn_ && isFile_ ? torn_->begin : size_);
  return whole > 0.0 ? std::min(1.0, static_cast<double>(done_) / whole) : -1.0;
}

std::string TextRecord::remark() const { return torn_ ? tornRemark(file_, torn_->bytes) : ""; }

}  // namespace

std::unique_ptr<RecordReader> readText(const std::filesystem::path& file, std::ifstream in) {
  return std::make_unique<TextRecord>(file, std::move(in));
}

}  // namespace ortung
