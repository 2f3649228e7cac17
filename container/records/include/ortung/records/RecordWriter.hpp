#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/core/Message.hpp"

namespace ortung {

/// The first line of a record that is lines of text.
inline constexpr std::string_view kRecordMagic = "# ortung record 1";

/// Writes a record file: notes ("# world ..."), then readings (docs/files.md).
///
/// It is compressed, in chunks of whole moments that can be read alone; or, where its name ends in
/// ".txt" and where it is no file (a pipe, a terminal), lines of text, each moment as it comes.
/// @throws std::runtime_error if the file can't be written, as do the others
/// Not thread-safe.
class ORTUNG_API RecordWriter {
 public:
  enum class Pace : std::uint8_t {
    kWhole,  ///< it appears whole, at commit(): for what can be had again
    kLive    ///< it is there from its first moment on, and grows
  };
  enum class Form : std::uint8_t { kByName, kText, kCompressed };
  /// Of a live record that is compressed, who kills the writer takes no more than so many seconds
  /// of readings, by their stamps; of one in lines the moment that is on its way.
  static constexpr double kLiveSeconds = 1.0;

  explicit RecordWriter(const std::filesystem::path& file, const std::string& worldFingerprint = "",
                        Pace pace = Pace::kWhole, Form form = Form::kByName);
  ~RecordWriter();  ///< without commit(): a live record keeps its whole moments, else none is left
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  void write(const Message& message);
  /// Says that the moment is whole. So does a message of a later one, and commit().
  void endMoment();
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
