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

inline constexpr std::size_t kMaxLogLine = 1u << 20;       ///< greatest length of a line [bytes]
inline constexpr std::uint64_t kMaxLogBytes = 1ull << 31;  ///< greatest decompressed size [bytes]
inline constexpr double kMaxLogSeconds = 1e10;             ///< greatest absolute time stamp [s]
inline constexpr double kMaxLogMetres = 1e6;               ///< greatest absolute coordinate [m]
inline constexpr double kMaxLogVelocity = 100.0;           ///< greatest velocity [m/s], [rad/s]

/// Returns whether a pose is one that a log may have: finite, and at most kMaxLogMetres away.
ORTUNG_API bool isPlausible(const Pose2& pose);

/// Returns @p path if there is such a file, or the same name with .xz or .gz appended, or nothing.
ORTUNG_API std::optional<std::filesystem::path> findLogFile(const std::filesystem::path& path);

/// Returns a file's name without an .xz or .gz at its end.
ORTUNG_API std::string unpackedName(const std::filesystem::path& file);

/// Returns which run of a folder is to be read: the option `run`, or else NAME of the only file
/// NAME + @p ending there, which may be compressed.
/// @throws std::runtime_error if the option is missing, and there is no such file or more than one
ORTUNG_API std::string runOf(const Parameters& options, const std::filesystem::path& folder,
                             std::string_view ending);

/// Reads all bytes of a file, and decompresses them if its name ends in .xz or .gz.
/// @throws std::runtime_error if it is missing, damaged or longer than @p maxBytes
ORTUNG_API std::string readLogBytes(const std::filesystem::path& file,
                                    std::uint64_t maxBytes = kMaxLogBytes);

/// Quotes text for an error: unprintable bytes are escaped, and it is cut after 40 bytes.
ORTUNG_API std::string inQuotes(std::string_view text);

/// Parses a finite number; nothing if anything else is in @p text.
ORTUNG_API std::optional<double> parseNumber(std::string_view text);

/// A text file of a foreign log, line by line, in fields separated by blanks. It may be compressed
/// (.xz, .gz). Every error names the file and the line, what was found and what was expected.
/// Not thread-safe.
class ORTUNG_API LogFile {
 public:
  /// Opens @p path or, if it does not exist, the same name with .xz or .gz appended.
  /// @throws std::runtime_error if there is none of them
  explicit LogFile(const std::filesystem::path& path, std::uint64_t maxBytes = kMaxLogBytes);
  enum Commas { kCommas };
  /// Opens a file whose fields are separated by commas, with or without blanks; nothing is quoted.
  LogFile(const std::filesystem::path& path, Commas);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Reads the next line that has a field; false at the end. Comments begin with '#' or '%'.
  /// @throws std::runtime_error for a line or a file beyond its limit, or damaged compression
  bool nextLine();
  /// Reads the next line that has a field and is not a comment; false at the end.
  bool nextRecord();

  /// Whether the current line is a comment.
  bool isComment() const;
  /// The current line without its end; valid until the next one is read.
  std::string_view line() const { return line_; }
  /// The current line's number, from 1.
  std::size_t lineNumber() const { return lineNumber_; }
  /// The file that was opened, with the .xz or .gz that was found.
  const std::filesystem::path& path() const { return path_; }
  std::string place() const;  ///< "FILE:LINE"

  // --- Fields of the current line, from 0. All functions throw as fail() does. ---
  /// Number of fields.
  std::size_t size() const { return fields_.size(); }
  /// The field as it was written.
  std::string_view text(std::size_t field) const;
  /// Reads a finite number within @p range.
  /// @param what names the quantity in the error, e.g. "a range [m]"
  double number(std::size_t field, const char* what, const Range& range = {}) const;
  /// Reads a whole number within @p range.
  std::int64_t integer(std::size_t field, const char* what, const Range& range) const;
  /// Reads a time stamp that is written in seconds.
  Timestamp stamp(std::size_t field) const;
  /// Reads a pose from three fields: x [m], y [m], theta [rad].
  Pose2 pose(std::size_t field) const;
  /// Fails unless the line has @p count fields. @param what names them in the error
  void needFields(std::size_t count, const char* what) const;

  /// @throws std::runtime_error "FILE:LINE: found FOUND, expected EXPECTED"
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  struct Stream;
  std::filesystem::path path_;
  std::unique_ptr<Stream> stream_;
  std::string line_;
  std::vector<std::string_view> fields_;  ///< fields of line_
  std::size_t lineNumber_ = 0;            ///< number of line_, from 1
  bool hasCommas_ = false;                ///< whether commas separate fields, else blanks
  bool torn_ = false;                     ///< whether the file ends within line_
};

/// Makes the stamps of one stream strictly increasing. The clocks of old logs jitter, while their
/// lines are in the right order: a stamp that is equal to the last one or a little earlier is
/// replaced by the last one + 1 us.
/// Not thread-safe.
class ORTUNG_API LogClock {
 public:
  /// @param jitter greatest step back that is tolerated [s]
  explicit LogClock(double jitter) : jitter_(jitter) {}
  /// Returns the corrected stamp. @throws std::runtime_error for a greater step back
  Timestamp operator()(const LogFile& file, Timestamp stamp);

 private:
  double jitter_;                  ///< greatest step back that is tolerated [s]
  std::optional<Timestamp> last_;  ///< newest stamp that was returned
};

}  // namespace ortung
