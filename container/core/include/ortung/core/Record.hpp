#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/core/Message.hpp"
#include "ortung/core/Source.hpp"

namespace ortung {

/// One reading as a line without its end:
/// "<stamp us> <model>/<type>/<feature> <number of words> <word> <word> ...".
/// Appends to @p line. The same line is the log and the wire.
ORTUNG_API void writeLine(const Message& message, std::string& line);

/// Reads such a line: exactly one blank between two words, none elsewhere. Nothing for anything
/// else; then @p why (if given) says what is wrong. Never throws, never allocates more than the
/// line is long.
ORTUNG_API std::optional<Message> parseLine(std::string_view line, std::string* why = nullptr);

inline constexpr std::size_t kMaxWords = 1u << 24;       ///< words of one reading
inline constexpr std::size_t kMaxLineBytes = 64u << 20;  ///< of a record
inline constexpr std::string_view kRecordMagic = "# ortung record 1";

/// Writes a record file: kRecordMagic, "# key value" lines (keys: world, robot, note), then
/// readings. @throws std::runtime_error if the file can't be written
/// Not thread-safe.
class ORTUNG_API RecordWriter {
 public:
  enum class Pace : std::uint8_t {
    kWhole,  ///< it appears whole, at commit(): for what can be had again
    kLive    ///< it is there from its first moment on, and grows moment by moment
  };
  explicit RecordWriter(const std::filesystem::path& file, const std::string& worldFingerprint = "",
                        Pace pace = Pace::kWhole);
  ~RecordWriter();  ///< without commit(): a live record keeps its whole moments, else none is left
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  void write(const Message& message);
  /// Says that the moment is whole. So does a message of a later one, and commit().
  void endMoment();
  void commit();
  std::size_t messages() const { return messages_; }

 private:
  NewFile file_;
  Pace pace_;
  std::string lines_;  ///< of the moment that is not whole yet
  Timestamp moment_ = 0;
  std::size_t messages_ = 0;
};

/// What is left out at the end of a record whose writer died: what follows its last whole moment.
struct TornRecord {
  std::uintmax_t begin = 0;  ///< bytes before it
  std::uintmax_t bytes = 0;
};

/// What a record file ends in, or nothing if it ends with a whole line.
/// @throws std::runtime_error if it can't be read
ORTUNG_API std::optional<TornRecord> tornEnd(const std::filesystem::path& file);

/// Cuts off what tornEnd() finds, and says what that was.
/// @throws std::runtime_error if the file can't be written, or is being written by somebody
ORTUNG_API std::optional<TornRecord> mendRecord(const std::filesystem::path& file);

/// Plays a record file (source kind "record"; part of the container, no plugin needed).
/// A torn one is played up to its last whole moment, or where that can't be known beforehand (a
/// pipe) up to its last whole line; remark() says so.
/// Not thread-safe.
class ORTUNG_API RecordSource : public Source {
 public:
  /// @throws std::runtime_error if it is not a record
  explicit RecordSource(const std::filesystem::path& file);
  ~RecordSource() override;

  bool next(Message& message) override;
  double progress() const override;
  bool isLive() const override { return !isFile_; }
  std::string remark() const override;
  std::string worldFingerprint() const override { return world_; }

 private:
  bool readWholeLine();
  [[noreturn]] void fail(const std::string& what) const;
  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  std::string world_;
  std::size_t lineNumber_ = 0;
  bool isFile_ = false;
  std::uintmax_t size_ = 0;  ///< of a file, when it was opened
  std::uintmax_t done_ = 0;
  std::optional<TornRecord> torn_;
  Timestamp last_;
};

}  // namespace ortung
