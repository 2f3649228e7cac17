#pragma once

#include <cstddef>
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

inline constexpr std::size_t kMaxWords = 1u << 24;  ///< words of one reading
inline constexpr std::string_view kRecordMagic = "# ortung record 1";

/// Writes a record file: kRecordMagic, "# key value" lines (keys: world, robot, note), then
/// readings. A NewFile: it appears at commit(). @throws std::runtime_error if the file can't be
/// written
/// Not thread-safe.
class ORTUNG_API RecordWriter {
 public:
  explicit RecordWriter(const std::filesystem::path& file,
                        const std::string& worldFingerprint = "");

  void write(const Message& message);
  void commit() { file_.commit(); }
  std::size_t messages() const { return messages_; }

 private:
  NewFile file_;
  std::string line_;
  std::size_t messages_ = 0;
};

/// Plays a record file (source kind "record"; part of the container, no plugin needed).
/// Not thread-safe.
class ORTUNG_API RecordSource : public Source {
 public:
  /// @throws std::runtime_error if it is not a record, or torn within its head
  explicit RecordSource(const std::filesystem::path& file);
  ~RecordSource() override;

  bool next(Message& message) override;
  double progress() const override;
  std::string worldFingerprint() const override { return world_; }

 private:
  void countLine();
  [[noreturn]] void fail(const std::string& what) const;
  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  std::string world_;
  std::size_t lineNumber_ = 0;
  double size_ = 0.0;
  double done_ = 0.0;
  Timestamp last_;
};

}  // namespace ortung
