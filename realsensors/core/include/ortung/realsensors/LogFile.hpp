#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ortung/base/Export.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

inline constexpr std::size_t kMaxLogLine = 1u << 20;       ///< bytes of one line
inline constexpr std::uint64_t kMaxLogBytes = 1ull << 31;  ///< of a file, decompressed
inline constexpr double kMaxLogSeconds = 1e10;             ///< of a time stamp, either sign
inline constexpr double kMaxLogMetres = 1e6;               ///< of a coordinate, either sign

/// The file itself, or the same name with .xz or .gz behind it; nothing if there is none of them.
ORTUNG_API std::optional<std::filesystem::path> findLogFile(const std::filesystem::path& path);

/// All bytes of a file that may be compressed.
/// @throws std::runtime_error if it is missing, damaged or longer than @p maxBytes
ORTUNG_API std::string readLogBytes(const std::filesystem::path& file,
                                    std::uint64_t maxBytes = kMaxLogBytes);

/// Text in quotes for an error: bytes nobody can print escaped, cut after 40.
ORTUNG_API std::string inQuotes(std::string_view text);

/// The finite number that the whole of @p text is, or nothing.
ORTUNG_API std::optional<double> parseNumber(std::string_view text);

/// A text file of a foreign log, line by line, in fields parted by blanks. It may be compressed
/// (.xz, .gz). Every error names file and line, what was found and what was expected.
/// Not thread-safe.
class ORTUNG_API LogFile {
 public:
  /// Opens @p path or, if there is none, the same name with .xz or .gz behind it.
  /// @throws std::runtime_error if there is none of them
  explicit LogFile(const std::filesystem::path& path, std::uint64_t maxBytes = kMaxLogBytes);
  enum Commas { kCommas };
  /// A file whose fields are parted by commas, with or without blanks: numbers, nothing in quotes.
  LogFile(const std::filesystem::path& path, Commas);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// The next line that has a field; false at the end. What is a comment begins with '#' or '%'.
  /// @throws std::runtime_error for a line or a file beyond its limit, or damaged compression
  bool nextLine();
  /// The next one that is no comment.
  bool nextRecord();

  bool isComment() const;
  std::string_view line() const { return line_; }
  std::size_t lineNumber() const { return lineNumber_; }
  const std::filesystem::path& path() const { return path_; }
  std::string place() const;  ///< "FILE:LINE"

  // --- fields of the line ---
  std::size_t size() const { return fields_.size(); }
  std::string_view text(std::size_t field) const;
  /// A finite number within @p range. @param what for the error, e.g. "a range [m]"
  double number(std::size_t field, const char* what, const Range& range = {}) const;
  /// A whole number within @p range.
  std::int64_t integer(std::size_t field, const char* what, const Range& range) const;
  /// A time stamp in seconds.
  Timestamp stamp(std::size_t field) const;
  /// Three fields: x [m], y [m], theta [rad].
  Pose2 pose(std::size_t field) const;
  /// @throws std::runtime_error unless the line has @p count fields: those that @p what names
  void needFields(std::size_t count, const char* what) const;

  /// @throws std::runtime_error "FILE:LINE: found FOUND, expected EXPECTED"
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  struct Stream;
  std::filesystem::path path_;
  std::unique_ptr<Stream> stream_;
  std::string line_;
  std::vector<std::string_view> fields_;
  std::size_t lineNumber_ = 0;
  bool hasCommas_ = false;
  bool torn_ = false;
};

/// Keeps the stamps of one stream rising. Clocks of old logs jitter, while their lines are in the
/// right order: a stamp that falls back a little, or stands still, becomes the last one and 1 us.
/// Not thread-safe.
class ORTUNG_API LogClock {
 public:
  /// @param jitter greatest step back that is put up with [s]
  explicit LogClock(double jitter) : jitter_(jitter) {}
  /// @throws std::runtime_error for a greater one
  Timestamp operator()(const LogFile& file, Timestamp stamp);

 private:
  double jitter_;
  std::optional<Timestamp> last_;
};

}  // namespace ortung
