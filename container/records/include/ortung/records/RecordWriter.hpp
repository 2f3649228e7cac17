#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/SensorContainer.hpp"
#include "ortung/core/Source.hpp"

namespace ortung {

/// The first line of a record that is lines of text.
inline constexpr std::string_view kRecordMagic = "# ortung record 1";

/// What a record says of itself before its readings.
struct RecordNotes {
  std::string world;  ///< fingerprint of the world where it was made; "": not known
  /// Formats of its features, as far as the writer knows them.
  FeatureFormats formats = {};
};

/// @returns formats of all features of a container, for the notes
ORTUNG_API FeatureFormats formatsOf(const SensorContainer& container);

/// Writes a record file: notes ("# world ..."), then readings (docs/files.md).
///
/// A record is compressed, in chunks of whole moments that can be read alone. If its name ends in
/// ".txt" or it is no regular file (a pipe, a terminal), it is lines of text, and each moment is
/// written as it comes.
/// @throws std::runtime_error if the file can't be written, as do the others
/// Not thread-safe.
class ORTUNG_API RecordWriter {
 public:
  enum class Pace : std::uint8_t {
    kWhole,  ///< it appears whole, at commit(): for readings that can be made again
    kLive    ///< it exists from its first moment on, and grows
  };
  /// The form of the file: kByName takes it from the file's name.
  enum class Form : std::uint8_t { kByName, kText, kCompressed };
  /// Longest time of readings [s], by their stamps, that a live compressed record loses if the
  /// writer is killed; a record in lines loses only the moment that is being written.
  static constexpr double kLiveSeconds = 1.0;

  explicit RecordWriter(const std::filesystem::path& file, const std::string& worldFingerprint = "",
                        Pace pace = Pace::kWhole, Form form = Form::kByName);
  RecordWriter(const std::filesystem::path& file, const RecordNotes& notes,
               Pace pace = Pace::kWhole, Form form = Form::kByName);
  ~RecordWriter();  ///< keeps the whole moments of a live record; removes others without commit()
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// Writes a reading. @pre its stamp is not earlier than that of the one before
  void write(const Message& message);
  /// Ends the present moment. A message of a later one, and commit(), end it, too.
  void endMoment();
  /// Completes the file, which is then in its place and on the disk.
  void commit();
  std::size_t messages() const { return messages_; }

 private:
  class Lines;
  class Chunks;
  struct Output;
  std::unique_ptr<Output> output_;
  Timestamp moment_ = 0;
  bool isInMoment_ = false;
  std::size_t messages_ = 0;
};

}  // namespace ortung
