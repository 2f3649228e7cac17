#include "ortung/records/RecordSource.hpp"

#include <stdexcept>

#include "Chunk.hpp"
#include "RecordReader.hpp"
#include "ortung/base/InputFile.hpp"
#include "ortung/records/RecordWriter.hpp"

namespace ortung {
namespace {

/// Returns the sum, limited to the range of stamps.
Timestamp later(Timestamp a, double seconds) {
  constexpr Timestamp kLatest = std::numeric_limits<Timestamp>::max();
  if (!(seconds < 1e12)) return kLatest;
  Timestamp sum = 0;
  return __builtin_add_overflow(a, fromSeconds(seconds), &sum) ? kLatest : sum;
}

}  // namespace

RecordReader::~RecordReader() = default;

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

}  // namespace ortung
