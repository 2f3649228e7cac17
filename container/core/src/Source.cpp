#include "ortung/core/Source.hpp"

#include <algorithm>
#include <stdexcept>

#include "ortung/base/FileKind.hpp"

namespace ortung {
namespace {

/// Most readings of one time step, more than any robot has features; a hostile file may give all
/// its readings the same stamp.
constexpr std::size_t kMostReadings = 65536;

/// Farthest stamp from 0, 36,000 years: sums and differences of readings' times must not overflow.
constexpr Timestamp kFarthest = Timestamp{1} << 60;

}  // namespace

Source::~Source() = default;

void Source::writeWorld(const std::filesystem::path&) const {
  throw std::runtime_error("these readings come without a map, so no world can be written");
}

namespace {

/// Returns the kind of source that plays a file, as far as its content tells; "": none.
std::string sourceOf(FileKind kind) {
  switch (kind) {
    case FileKind::kRecord:
      return "record";
    case FileKind::kMcap:
      return "mcap";
    case FileKind::kSqlite:
    case FileKind::kRosBag:
    case FileKind::kRosBagFolder:
      return "bag";
    case FileKind::kCarmenLog:
      return "carmen";
    default:
      return "";
  }
}

/// Whether a text begins with KIND:.
bool namesKind(const std::string& text) {
  const std::string kind = text.substr(0, text.find(':'));
  return kind.size() < text.size() && !kind.empty() && kind.size() <= 64 &&
         std::all_of(
             kind.begin(), kind.end(),
             [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
             });
}

/// Returns KIND:PATH for a text that is the path of a file which tells its kind itself.
std::string withKind(const std::string& text) {
  if (namesKind(text)) return text;
  const std::string kind = sourceOf(kindOfFile(text.substr(0, text.find('?'))));
  return kind.empty() ? text : kind + ":" + text;
}

}  // namespace

SourceText parseSourceText(const std::string& given) {
  const std::string text = withKind(given);
  if (!namesKind(text)) {
    throw std::invalid_argument("source '" + text +
                                "': expected KIND:PATH[?key=value&...], e.g. record:run.rec, or a "
                                "record, bag or log that says what it is" +
                                whatItIs(text));
  }
  const std::size_t colon = text.find(':');
  SourceText source{text.substr(0, colon), text.substr(colon + 1), {}};
  const std::size_t mark = source.path.find('?');
  if (mark == source.path.npos) return source;
  std::string options = source.path.substr(mark + 1);
  source.path.resize(mark);
  while (!options.empty()) {
    const std::size_t end = std::min(options.find('&'), options.size());
    const std::string option = options.substr(0, end);
    options.erase(0, end + 1);
    const std::size_t equals = option.find('=');
    if (equals == option.npos || equals == 0) {
      throw std::invalid_argument("source '" + text + "': option '" + option +
                                  "' is not key=value");
    }
    if (!source.options.emplace(option.substr(0, equals), option.substr(equals + 1)).second) {
      throw std::invalid_argument("source '" + text + "': option '" + option.substr(0, equals) +
                                  "' is given twice");
    }
  }
  return source;
}

bool FrameReader::next(std::vector<Message>& frame) {
  frame.clear();
  if (!ahead_) {
    Message first;
    if (!source_.next(first)) return false;
    ahead_ = std::move(first);
  }
  const Timestamp now = ahead_->stamp;
  if (now < -kFarthest || now > kFarthest)
    throw std::runtime_error(toText(ahead_->id) + " is of " + std::to_string(now) +
                             " us, expected a time within 2^60 us of 0");
  frame.push_back(std::move(*ahead_));
  ahead_.reset();
  Message message;
  while (source_.next(message)) {
    if (message.stamp == now) {
      if (frame.size() == kMostReadings)
        throw std::runtime_error("there are more than " + std::to_string(kMostReadings) +
                                 " readings at " + std::to_string(now) + " us");
      frame.push_back(message);
      continue;
    }
    if (message.stamp < now) {
      throw std::runtime_error("time runs backwards: " + toText(message.id) + " at " +
                               std::to_string(message.stamp) + " us after " + std::to_string(now) +
                               " us");
    }
    ahead_ = std::move(message);
    break;
  }
  return true;
}

}  // namespace ortung
