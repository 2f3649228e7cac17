#include "ortung/records/RecordWriter.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "Chunk.hpp"
#include "RecordReader.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/core/ReadingLine.hpp"

namespace ortung {
namespace {

constexpr int kTextLevel = 3;   // level of zstd
constexpr int kApartLevel = 1;  // for pictures a higher level costs more than it saves
constexpr std::size_t kTextOfAChunk = 256U << 10;
constexpr std::size_t kApartOfAChunk = 4U << 20;
constexpr std::size_t kTextOfAMoment = 32U << 20;  // the rest is cut off

/// Returns the time between two stamps [us], which may be as far apart as the type allows.
std::uint64_t passedSince(Timestamp before, Timestamp now) {
  return static_cast<std::uint64_t>(now) - static_cast<std::uint64_t>(before);
}

std::string textOf(const RecordNotes& notes) {
  std::string text = std::string(kRecordMagic) + "\n";
  if (!notes.world.empty()) text += std::string(kWorldNote) + notes.world + "\n";
  for (const auto& [id, format] : notes.formats)
    text += std::string(kFormatNote) + toText(id) + " " + format.toText() + "\n";
  return text;
}

}  // namespace

/// The output of time steps.
struct RecordWriter::Output {
  Output(std::unique_ptr<NewFile> file, Pace pace)
      : file_(std::move(file)), isLive_(pace == Pace::kLive) {}
  virtual ~Output() = default;
  virtual void write(const Message& message) = 0;
  virtual void endMoment() = 0;
  virtual void commit() = 0;

 protected:
  std::unique_ptr<NewFile> file_;
  const bool isLive_;
};

class RecordWriter::Lines final : public Output {
 public:
  Lines(std::unique_ptr<NewFile> file, const RecordNotes& notes, Pace pace)
      : Output(std::move(file), pace) {
    file_->write(textOf(notes));
  }
  void write(const Message& message) override {
    writeLine(message, lines_);
    lines_ += '\n';
  }
  void endMoment() override {
    file_->write(lines_);
    lines_.clear();
    if (isLive_) file_->publish();
  }
  void commit() override { file_->commit(); }

 private:
  std::string lines_;  ///< lines of the current time step
};

class RecordWriter::Chunks final : public Output {
 public:
  Chunks(std::unique_ptr<NewFile> file, const RecordNotes& notes, Pace pace)
      : Output(std::move(file), pace) {
    file_->write(chunk::magic());
    lines_ = textOf(notes);
    wholeLines_ = lines_.size();
    flush();
  }
  ~Chunks() override {
    if (!isLive_ || hasFailed_) return;
    try {
      flush();
    } catch (const std::exception&) {  // callers that need the error call commit()
    }
  }

  void write(const Message& message) override {
    if (head_.readings++ == 0) head_.first = message.stamp;
    head_.last = message.stamp;
    if (message.words.size() <= chunk::kMaxTextWords) {
      writeLine(message, lines_);
    } else {
      const std::uint32_t stride = chunk::writeApart(message.words, apartPacker_, apart_);
      lines_ += chunk::kApartNote;
      lines_ += std::to_string(message.stamp) + ' ' + toText(message.id) + ' ' +
                std::to_string(message.words.size()) + ' ' + std::to_string(stride);
      ++head_.apart;
    }
    lines_ += '\n';
    if (lines_.size() - wholeLines_ > kTextOfAMoment) endMoment();
  }

  void endMoment() override {
    whole_ = head_;
    wholeLines_ = lines_.size();
    wholeApart_ = apart_.size();
    const bool isFull = wholeLines_ >= kTextOfAChunk || wholeApart_ >= kApartOfAChunk;
    const bool isDue =
        isLive_ && (index_.empty() || passedSince(since_, head_.last) >= kLivePeriod);
    if (isFull || isDue) flush();
  }

  void commit() override {
    flush();
    file_->write(chunk::write(index_, file_->size(), packer_));
    file_->commit();
  }

 private:
  static constexpr auto kLivePeriod = static_cast<std::uint64_t>(kLiveSeconds * 1e6);  // [us]

  /// Writes the whole time steps as a chunk.
  void flush() {
    if (hasFailed_) throw std::runtime_error("a record can't go on where it could not be written");
    if (wholeLines_ == 0) return;
    packed_.clear();
    chunk::Head head = whole_;
    head.textBytes = wholeLines_;
    head.packedBytes = packer_.pack(std::string_view(lines_).substr(0, wholeLines_), packed_);
    head.apartBytes = wholeApart_;
    const std::string begin = chunk::write(head, packer_);
    if (head.readings > 0) index_.push_back({file_->size(), head.first});
    packed_.insert(0, begin);
    packed_.append(apart_, 0, wholeApart_);
    hasFailed_ = true;  // so that nothing is written behind a missing chunk
    file_->write(packed_);
    if (isLive_ && head.readings > 0) file_->publish();
    hasFailed_ = false;
    since_ = head.last;
    lines_.clear();
    apart_.clear();
    wholeLines_ = wholeApart_ = 0;
    head_ = whole_ = {};
  }

  zstd::Packer packer_{kTextLevel};
  zstd::Packer apartPacker_{kApartLevel};
  std::string lines_;  ///< lines of the chunk, and of the current time step
  std::string apart_;  ///< frames with large readings of the chunk and of that time step
  std::string packed_;
  chunk::Head head_;
  chunk::Head whole_;  ///< head without that time step, which the two sizes below leave out, too
  std::size_t wholeLines_ = 0;
  std::size_t wholeApart_ = 0;
  bool hasFailed_ = false;
  Timestamp since_ = 0;  ///< stamp of the last reading that is in the file
  std::vector<chunk::Place> index_;
};

FeatureFormats formatsOf(const SensorContainer& container) {
  FeatureFormats formats;
  for (const auto& data : container.all()) formats.emplace_back(data->id(), data->format());
  return formats;
}

RecordWriter::RecordWriter(const std::filesystem::path& file, const std::string& worldFingerprint,
                           Pace pace, Form form)
    : RecordWriter(file, RecordNotes{worldFingerprint}, pace, form) {}

RecordWriter::RecordWriter(const std::filesystem::path& file, const RecordNotes& notes, Pace pace,
                           Form form) {
  auto out = std::make_unique<NewFile>(file);
  if (form == Form::kByName)
    form = file.extension() == ".txt" || out->isStream() ? Form::kText : Form::kCompressed;
  if (form == Form::kText) {
    output_ = std::make_unique<Lines>(std::move(out), notes, pace);
  } else {
    output_ = std::make_unique<Chunks>(std::move(out), notes, pace);
  }
}

RecordWriter::~RecordWriter() = default;

void RecordWriter::write(const Message& message) {
  if (isInMoment_ && message.stamp != moment_) endMoment();
  moment_ = message.stamp;
  isInMoment_ = true;
  output_->write(message);
  ++messages_;
}

void RecordWriter::endMoment() {
  if (!isInMoment_) return;
  isInMoment_ = false;
  output_->endMoment();
}

void RecordWriter::commit() {
  endMoment();
  output_->commit();
}

}  // namespace ortung
