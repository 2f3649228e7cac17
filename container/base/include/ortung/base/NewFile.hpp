#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A file that appears whole or not at all: it is written out of sight and put in its place at
/// commit(), once it is on the disk. Until then an older file of that name stays. A program that
/// dies before leaves nothing behind (where the file system has no files without a name: one named
/// ".ortung-part-...", which the next NewFile in that folder clears away).
///
/// Or publish() puts it in its place, where it grows: what was written by the last flush() is there
/// whatever happens to the program.
///
/// Links are followed, so a link stays and what it names is replaced. What is no regular file (a
/// device, a FIFO, /dev/stdout) is written to as it comes. Not thread-safe.
class ORTUNG_API NewFile {
 public:
  /// Opens a new file out of sight. @throws std::runtime_error naming file and reason, as do the
  /// other members
  explicit NewFile(std::filesystem::path file);
  ~NewFile();  ///< removes what was written, unless commit() or publish() came before
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Appends to the file.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  /// Hands what was written to the operating system, so that the death of this process can't take
  /// it away. Where that fails, a published file is cut back to what it was at the last flush().
  void flush();
  void publish();  ///< flushes and puts the file in its place, to grow there
  void commit();   ///< flushes, puts the file in its place once it is on the disk, and closes it

  /// Returns whether it is no regular file, or one that this process has open as an output.
  bool isStream() const { return state_ == State::kStream; }
  std::uintmax_t size() const { return size_ + buffer_.size(); }  ///< bytes written so far

 private:
  enum class State : std::uint8_t { kUnnamed, kNamed, kInPlace, kStream, kClosed };
  void open();
  void openUnnamedOrNamed();
  void openNamed();
  void keepOwnership();
  void emptyBuffer();
  void putInPlace();
  void replace(const std::filesystem::path& named);
  void syncFolder() const;
  [[noreturn]] void fail() const;

  std::filesystem::path file_;    ///< path as the caller gave it, for error messages
  std::filesystem::path place_;   ///< path of the file itself, behind all links (kUnnamed, kNamed)
  std::filesystem::path folder_;  ///< folder that holds place_
  std::filesystem::path named_;   ///< temporary path until the file is put in its place (kNamed)
  State state_ = State::kClosed;
  int descriptor_ = -1;
  std::string buffer_;
  std::uintmax_t size_ = 0;     ///< bytes written to the file; those in the buffer are not counted
  std::uintmax_t flushed_ = 0;  ///< size at the last flush
};

/// Writes a whole file at once, which appears whole or not at all. @throws std::runtime_error
/// naming file and reason
ORTUNG_API void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);
ORTUNG_API void writeFile(const std::filesystem::path& file, std::string_view text);

/// Returns the path that writing to that name would lead to: itself, or what a chain of links
/// names. A name of one of this process's own descriptors (/dev/stdout, /dev/fd/3) is not followed.
ORTUNG_API std::filesystem::path behindLinks(const std::filesystem::path& file);

}  // namespace ortung
