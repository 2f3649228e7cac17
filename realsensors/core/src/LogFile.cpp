#include "ortung/realsensors/LogFile.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>

#include "LogStream.hpp"

namespace ortung {
namespace {

constexpr std::size_t kBlock = 1u << 16;
constexpr std::size_t kShown = 40;  // bytes of a text that an error shows

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

void split(std::string_view line, std::vector<std::string_view>& fields) {
  std::size_t at = 0;
  while (at < line.size()) {
    while (at < line.size() && isBlank(line[at])) ++at;
    const std::size_t begin = at;
    while (at < line.size() && !isBlank(line[at])) ++at;
    if (at > begin) fields.push_back(line.substr(begin, at - begin));
  }
}

/// Splits a line at its commas. Empty fields are kept: reading a number from one is an error.
void splitAtCommas(std::string_view line, std::vector<std::string_view>& fields) {
  while (!line.empty() && isBlank(line.back())) line.remove_suffix(1);
  if (line.empty()) return;
  for (std::size_t begin = 0, end = 0; end != line.npos; begin = end + 1) {
    end = line.find(',', begin);
    std::string_view field = line.substr(begin, end == line.npos ? line.npos : end - begin);
    while (!field.empty() && isBlank(field.front())) field.remove_prefix(1);
    while (!field.empty() && isBlank(field.back())) field.remove_suffix(1);
    fields.push_back(field);
  }
}

std::string shortNumber(double value) {
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
  return {text.data(), end};
}

std::string rangeText(const Range& range) {
  if (std::isinf(range.low) && std::isinf(range.high)) return "";
  if (std::isinf(range.high)) return " of at least " + shortNumber(range.low);
  if (std::isinf(range.low)) return " of at most " + shortNumber(range.high);
  return " in [" + shortNumber(range.low) + ", " + shortNumber(range.high) + "]";
}

}  // namespace

bool isPlausible(const Pose2& pose) {
  return isFinite(pose) && std::abs(pose.x) <= kMaxLogMetres && std::abs(pose.y) <= kMaxLogMetres;
}

std::optional<std::filesystem::path> findLogFile(const std::filesystem::path& path) {
  for (const char* ending : {"", ".xz", ".gz"}) {
    std::filesystem::path candidate = path;
    candidate += ending;
    std::error_code error;
    if (std::filesystem::is_regular_file(candidate, error)) return candidate;
  }
  return std::nullopt;
}

std::string unpackedName(const std::filesystem::path& file) {
  const bool isPacked = file.extension() == ".xz" || file.extension() == ".gz";
  return (isPacked ? file.stem() : file.filename()).string();
}

std::string runOf(const Parameters& options, const std::filesystem::path& folder,
                  std::string_view ending) {
  if (options.has("run")) return options.text("run");
  std::set<std::string> runs;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = unpackedName(entry.path());
    if (name.size() <= ending.size() || !name.ends_with(ending)) continue;
    runs.insert(name.substr(0, name.size() - ending.size()));
  }
  if (runs.size() == 1) return *runs.begin();
  if (runs.empty())
    throw std::runtime_error(folder.string() + ": found no file NAME" + std::string(ending) +
                             ", expected one");
  std::string names;
  for (const std::string& run : runs) names += (names.empty() ? "" : ", ") + inQuotes(run);
  throw std::runtime_error(folder.string() + ": found the runs " + names +
                           ", expected the option run to name one of them");
}

std::string readLogBytes(const std::filesystem::path& file, std::uint64_t maxBytes) {
  LogStream stream(file, maxBytes);
  std::string bytes;
  std::array<char, kBlock> block;
  while (const std::size_t count = stream.read(block.data(), block.size())) {
    bytes.append(block.data(), count);
  }
  return bytes;
}

std::string inQuotes(std::string_view text) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string result = "'";
  for (const char c : text.substr(0, kShown)) {
    if (c >= ' ' && c < 127) {
      result += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      result += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return result + (text.size() > kShown ? "'..." : "'");
}

std::optional<double> parseNumber(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

struct LogFile::Stream {
  Stream(const std::filesystem::path& path, std::uint64_t maxBytes) : bytes(path, maxBytes) {}

  /// Appends the rest of the block up to the end of the line; returns whether the line ended here.
  bool take(std::string& line) {
    const char* start = block.data() + begin;
    const void* found = std::memchr(start, '\n', end - begin);
    const std::size_t length =
        found ? static_cast<std::size_t>(static_cast<const char*>(found) - start) : end - begin;
    line.append(start, length);
    begin += length + (found ? 1 : 0);
    return found != nullptr;
  }

  LogStream bytes;
  std::array<char, kBlock> block{};
  std::size_t begin = 0;
  std::size_t end = 0;
};

LogFile::LogFile(const std::filesystem::path& path, std::uint64_t maxBytes) {
  const auto found = findLogFile(path);
  if (!found) {
    throw std::runtime_error(path.string() +
                             ": found no such file, nor one with .xz or .gz behind"
                             " its name, expected one of them");
  }
  path_ = *found;
  stream_ = std::make_unique<Stream>(path_, maxBytes);
}

LogFile::LogFile(const std::filesystem::path& path, Commas) : LogFile(path) { hasCommas_ = true; }

LogFile::~LogFile() = default;

bool LogFile::nextLine() {
  do {
    line_.clear();
    fields_.clear();
    ++lineNumber_;
    while (!stream_->take(line_)) {
      if (line_.size() > kMaxLogLine) break;
      stream_->begin = 0;
      stream_->end = stream_->bytes.read(stream_->block.data(), stream_->block.size());
      if (stream_->end != 0) continue;
      if (line_.empty()) return false;
      torn_ = true;
      break;
    }
    if (line_.size() > kMaxLogLine) {
      fail("a line of more than " + std::to_string(kMaxLogLine) + " bytes", "a shorter one");
    }
    fields_.clear();
    hasCommas_ ? splitAtCommas(line_, fields_) : split(line_, fields_);
  } while (fields_.empty());
  return true;
}

bool LogFile::nextRecord() {
  while (nextLine()) {
    if (!isComment()) return true;
  }
  return false;
}

bool LogFile::isComment() const {
  return !fields_.empty() && (fields_[0].starts_with('#') || fields_[0].starts_with('%'));
}

std::string_view LogFile::text(std::size_t field) const {
  return field < fields_.size() ? fields_[field] : std::string_view();
}

double LogFile::number(std::size_t field, const char* what, const Range& range) const {
  const auto value = field < fields_.size() ? parseNumber(fields_[field]) : std::nullopt;
  if (!value || *value < range.low || *value > range.high) {
    const std::string found =
        field < fields_.size() ? inQuotes(fields_[field]) + " in field " + std::to_string(field + 1)
                               : std::to_string(fields_.size()) + " fields";
    fail(found, what + (", a number" + rangeText(range)));
  }
  return *value;
}

std::int64_t LogFile::integer(std::size_t field, const char* what, const Range& range) const {
  const double value = number(field, what, range);
  if (value != std::floor(value) || std::abs(value) > 9e15) {
    fail(inQuotes(text(field)) + " in field " + std::to_string(field + 1),
         what + (", a whole number" + rangeText(range)));
  }
  return static_cast<std::int64_t>(value);
}

Timestamp LogFile::stamp(std::size_t field) const {
  return fromSeconds(number(field, "a time [s]", {-kMaxLogSeconds, kMaxLogSeconds}));
}

Pose2 LogFile::pose(std::size_t field) const {
  const Range metres{-kMaxLogMetres, kMaxLogMetres};
  const double x = number(field, "x [m]", metres);
  const double y = number(field + 1, "y [m]", metres);
  return {x, y, wrapAngle(number(field + 2, "an angle [rad]", {-1e6, 1e6}))};
}

void LogFile::needFields(std::size_t count, const char* what) const {
  if (fields_.size() == count) return;
  fail(std::to_string(fields_.size()) + " fields", std::to_string(count) + ": " + what);
}

std::string LogFile::place() const { return path_.string() + ":" + std::to_string(lineNumber_); }

void LogFile::fail(const std::string& found, const std::string& expected) const {
  throw std::runtime_error(place() + ": found " + found + ", expected " + expected +
                           (torn_ ? " (the file ends within this line)" : ""));
}

Timestamp LogClock::operator()(const LogFile& file, Timestamp stamp) {
  if (last_ && stamp <= *last_) {
    if (toSeconds(*last_ - stamp) > jitter_) {
      file.fail("time " + shortNumber(toSeconds(stamp)) + " s after " +
                    shortNumber(toSeconds(*last_)) + " s",
                "time to run forwards, or back by at most jitter_s=" + shortNumber(jitter_) + " s");
    }
    stamp = *last_ + 1;
  }
  last_ = stamp;
  return stamp;
}

}  // namespace ortung
