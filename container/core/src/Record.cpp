#include "ortung/core/Record.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "ortung/base/InputFile.hpp"

namespace ortung {
namespace {

constexpr std::string_view kWorldKey = "# world ";

template <class Number>
void append(std::string& line, Number value) {
  char digits[24];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  line.append(digits, end);
}

/// Cuts the next token off @p rest; tokens are separated by exactly one blank.
std::string_view cutToken(std::string_view& rest) {
  const std::size_t blank = rest.find(' ');
  const std::string_view token = rest.substr(0, blank);
  rest = blank == rest.npos ? std::string_view() : rest.substr(blank + 1);
  return token;
}

template <class Number>
bool parseWhole(std::string_view token, Number& value) {
  const auto result = std::from_chars(token.data(), token.data() + token.size(), value);
  return result.ec == std::errc() && result.ptr == token.data() + token.size() && !token.empty();
}

std::optional<Message> refuse(std::string* why, std::string reason) {
  if (why != nullptr) *why = std::move(reason);
  return std::nullopt;
}

std::string quoted(std::string_view token) {
  std::string text = "'";
  for (const char c : token.substr(0, 40)) text += (c >= 0x20 && c < 0x7F) ? c : '?';
  return text + (token.size() > 40 ? "...'" : "'");
}

/// Like std::getline, but gives up on a line longer than kMaxLineBytes, so that no file can eat the
/// memory: then the line is longer than that, and the stream stays where it is.
bool readLine(std::istream& in, std::string& line) {
  line.clear();
  char piece[4096];
  while (line.size() <= kMaxLineBytes) {
    in.getline(piece, sizeof piece);
    const auto count = static_cast<std::size_t>(in.gcount());
    const bool filled =
        in.fail() && !in.eof() && !in.bad() && count > 0;  // no end of line within the piece
    const bool ended = !in.fail() && !in.eof();            // the end of line counts, too
    line.append(piece, ended ? count - 1 : count);
    if (!filled) return !line.empty() || ended;
    in.clear(in.rdstate() & ~std::ios::failbit);
  }
  return true;
}

}  // namespace

void writeLine(const Message& message, std::string& line) {
  append(line, message.stamp);
  line += ' ';
  line += toText(message.id);
  line += ' ';
  append(line, message.words.size());
  for (const std::uint32_t word : message.words) {
    line += ' ';
    append(line, word);
  }
}

std::optional<Message> parseLine(std::string_view line, std::string* why) {
  Message message;
  if (line.ends_with(' ')) return refuse(why, "the line ends with a blank");
  const std::string_view stamp = cutToken(line);
  if (!parseWhole(stamp, message.stamp)) {
    return refuse(why, "found " + quoted(stamp) + ", expected a time stamp in microseconds");
  }
  const std::string_view id = cutToken(line);
  try {
    message.id = parseSensorId(id);
  } catch (const std::invalid_argument& error) {
    return refuse(why, "found " + quoted(id) + ": " + error.what());
  }
  const std::string_view countToken = cutToken(line);
  std::size_t count = 0;
  if (!parseWhole(countToken, count) || count > kMaxWords) {
    return refuse(why, "found " + quoted(countToken) + ", expected a number of words");
  }
  if (count > line.size()) {
    return refuse(why, "the line is torn: it announces " + std::to_string(count) + " words");
  }
  message.words.reserve(count);
  while (!line.empty()) {
    const std::string_view token = cutToken(line);
    std::uint32_t word = 0;
    if (!parseWhole(token, word)) {
      return refuse(why, "found " + quoted(token) + ", expected an unsigned 32-bit word");
    }
    message.words.push_back(word);
  }
  if (message.words.size() != count) {
    return refuse(why, "found " + std::to_string(message.words.size()) + " words, expected " +
                           std::to_string(count) + " as the line announces");
  }
  return message;
}

RecordWriter::RecordWriter(const std::filesystem::path& file, const std::string& worldFingerprint,
                           Pace pace)
    : file_(file), pace_(pace) {
  file_.write(std::string(kRecordMagic) + "\n");
  if (!worldFingerprint.empty()) file_.write(std::string(kWorldKey) + worldFingerprint + "\n");
}

RecordWriter::~RecordWriter() = default;

void RecordWriter::write(const Message& message) {
  if (!lines_.empty() && message.stamp != moment_) endMoment();
  moment_ = message.stamp;
  writeLine(message, lines_);
  lines_ += '\n';
  ++messages_;
}

void RecordWriter::endMoment() {
  if (lines_.empty()) return;
  file_.write(lines_);
  lines_.clear();
  if (pace_ == Pace::kLive) file_.publish();
}

void RecordWriter::commit() {
  endMoment();
  file_.commit();
}

RecordSource::RecordSource(const std::filesystem::path& file)
    : file_(file), last_(std::numeric_limits<Timestamp>::min()) {
  std::string why;
  in_ = openInput(file, why);
  if (!in_) throw std::runtime_error(file.string() + ": " + why);
  isFile_ = std::filesystem::is_regular_file(file);
  if (isFile_) {
    size_ = std::filesystem::file_size(file);
    torn_ = tornEnd(file);
  }
  char magic[kRecordMagic.size() + 1];
  in_.read(magic, sizeof magic);
  if (in_.bad()) throw std::runtime_error(file.string() + ": " + cantBeRead(errno));
  const std::string_view found(magic, static_cast<std::size_t>(in_.gcount()));
  if (found != std::string(kRecordMagic) + "\n") {
    throw std::runtime_error(file.string() + ":1: found " +
                             quoted(found.substr(0, found.find('\n'))) + ", expected '" +
                             std::string(kRecordMagic) + "'");
  }
  lineNumber_ = 1;
  done_ = sizeof magic;
  while (in_.peek() == '#' && readWholeLine()) {
    if (line_.starts_with(kWorldKey)) world_ = line_.substr(kWorldKey.size());
  }
}

RecordSource::~RecordSource() = default;

void RecordSource::fail(const std::string& what) const {
  throw std::runtime_error(file_.string() + ":" + std::to_string(lineNumber_) + ": " + what);
}

/// The next line; false at the end of what is whole.
bool RecordSource::readWholeLine() {
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

bool RecordSource::next(Message& message) {
  while (readWholeLine()) {
    if (line_.starts_with('#')) continue;
    std::string why;
    auto parsed = parseLine(line_, &why);
    if (!parsed) fail(why);
    if (parsed->stamp < last_) {
      fail("time runs backwards: found " + std::to_string(parsed->stamp) + " us after " +
           std::to_string(last_) + " us");
    }
    last_ = parsed->stamp;
    message = std::move(*parsed);
    return true;
  }
  if (in_.bad()) fail("reading failed");
  return false;
}

double RecordSource::progress() const {
  const auto whole = static_cast<double>(torn_ && isFile_ ? torn_->begin : size_);
  return whole > 0.0 ? std::min(1.0, static_cast<double>(done_) / whole) : -1.0;
}

std::string RecordSource::remark() const {
  if (!torn_) return "";
  return file_.string() + " is torn: its last " + std::to_string(torn_->bytes) +
         " bytes are no whole moment and are left out (was the recorder killed, or is it still "
         "writing?)";
}

}  // namespace ortung
