#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/Source.hpp"

namespace ortung {

class RecordReader;

/// Returns whether a file with these first bytes (24 or more) is a record.
ORTUNG_API bool isRecord(std::string_view begin);

/// Part of a record: the readings from @p from on and before @p to [s], both counted from the
/// record's first reading.
struct RecordPart {
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
};

/// Plays a record file (source kind "record"; no plugin needed), compressed or lines of text.
/// A torn record is played up to its last whole moment, or where that can't be known beforehand
/// (lines from a pipe) up to its last whole line; remark() says so. In a compressed file, readings
/// before the part are skipped without reading them.
///
/// It needs at most 64 MiB of memory for lines and 64 MiB for a reading, whatever the file holds.
/// Not thread-safe.
class ORTUNG_API RecordSource : public Source {
 public:
  /// @throws std::runtime_error if it is not a record
  explicit RecordSource(const std::filesystem::path& file, const RecordPart& part = {});
  ~RecordSource() override;

  bool next(Message& message) override;
  double progress() const override;
  bool isLive() const override;
  std::string remark() const override;
  std::string worldFingerprint() const override;
  /// Returns the formats that its notes say. Records of earlier versions have none.
  FeatureFormats formats() const override;
  /// Returns whether it is compressed; else it is lines of text.
  bool isCompressed() const { return isCompressed_; }

 private:
  void begin();

  std::unique_ptr<RecordReader> reader_;
  RecordPart part_;
  bool isCompressed_ = false;
  bool hasBegun_ = false;
  bool isOver_ = false;
  Timestamp from_ = std::numeric_limits<Timestamp>::min();
  Timestamp to_ = std::numeric_limits<Timestamp>::max();
  std::optional<Message> first_;
};

}  // namespace ortung
