#include "ortung/records/RecordSource.hpp"

#include <stdexcept>

#include "Chunk.hpp"
#include "RecordReader.hpp"
#include "ortung/base/InputFile.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostFormats = 4096;  ///< as many features as a robot has at most

/// Returns the sum, limited to the range of stamps.
Timestamp later(Timestamp a, double seconds) {
  constexpr Timestamp kLatest = std::numeric_limits<Timestamp>::max();
  if (!(seconds < 1e12)) return kLatest;
  Timestamp sum = 0;
  return __builtin_add_overflow(a, fromSeconds(seconds), &sum) ? kLatest : sum;
}

/// Returns a feature and its format; nothing for a note of a later version or a damaged one, since
/// readings are what counts.
std::optional<std::pair<SensorId, Format>> formatIn(std::string_view note) {
  const std::size_t blank = note.find(' ');
  if (blank == note.npos) return std::nullopt;
  try {
    return std::pair(parseSensorId(note.substr(0, blank)), parseFormat(note.substr(blank + 1)));
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace

RecordReader::~RecordReader() = default;

void RecordReader::takeNote(std::string_view line) {
  if (line.starts_with(kWorldNote)) world_ = line.substr(kWorldNote.size());
  if (!line.starts_with(kFormatNote) || formats_.size() == kMostFormats) return;
  line.remove_prefix(kFormatNote.size());
  if (auto format = formatIn(line)) formats_.push_back(std::move(*format));
}

std::string tornRemark(const std::filesystem::path& file, std::uintmax_t bytes) {
  return file.string() + " is torn: its last " + std::to_string(bytes) +
         " bytes are no whole moment and are left out (was the recorder killed, or is it still "
         "writing?)";
}

void checkOrder(const std::string& where, Timestamp last, Timestamp next) {
  if (next < last)
    throw std::runtime_error(where + "time runs backwards: found " + std::to_string(next) +
                             " us after " + std::to_string(last) + " us");
}

bool isRecord(std::string_view begin) {
  return begin.starts_with(kRecordMagic) || begin.starts_with(chunk::magic());
}

RecordSource::RecordSource(const std::filesystem::path& file, const RecordPart& part)
    : part_(part) {
  std::string why;
  std::ifstream in = openInput(file, why);
  if (!in) throw std::runtime_error(file.string() + ": " + why);
  isCompressed_ = chunk::begins(file, in);
  reader_ = isCompressed_ ? readChunks(file, std::move(in)) : readText(file, std::move(in));
}

RecordSource::~RecordSource() = default;

/// Finds the part's begin, which counts from the record's first reading.
void RecordSource::begin() {
  hasBegun_ = true;
  Message first;
  isOver_ = !reader_->next(first);
  if (isOver_) return;
  from_ = later(first.stamp, part_.from);
  to_ = later(first.stamp, part_.to);
  if (part_.from > 0.0) {
    reader_->seek(from_);
  } else {
    first_ = std::move(first);
  }
}

bool RecordSource::next(Message& message) {
  if (!hasBegun_) begin();
  if (isOver_) return false;
  if (first_) {
    message = std::move(*first_);
    first_.reset();
  } else {
    do {
      isOver_ = !reader_->next(message);
    } while (!isOver_ && message.stamp < from_);
  }
  if (message.stamp >= to_ && to_ != std::numeric_limits<Timestamp>::max()) isOver_ = true;
  return !isOver_;
}

double RecordSource::progress() const { return reader_->progress(); }

bool RecordSource::isLive() const { return !reader_->isFile(); }

std::string RecordSource::remark() const { return reader_->remark(); }

std::string RecordSource::worldFingerprint() const { return reader_->world(); }

FeatureFormats RecordSource::formats() const { return reader_->formats(); }

}  // namespace ortung
