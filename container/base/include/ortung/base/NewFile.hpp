#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string_view>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A file that appears whole or not at all: it is written beside its place and put there at
/// commit(), once it is on the disk. Until then an older file of that name stays. Not thread-safe.
class ORTUNG_API NewFile {
 public:
  /// @throws std::runtime_error naming file and reason, as do the others
  explicit NewFile(std::filesystem::path file);
  ~NewFile();  ///< without commit(): leaves nothing behind
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  void commit();

 private:
  [[noreturn]] void fail() const;
  void syncFolder() const;

  std::filesystem::path file_;
  std::filesystem::path temporary_;
  std::FILE* out_;  ///< null once it is in place
};

/// A whole file at once. @throws std::runtime_error naming file and reason
ORTUNG_API void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);
ORTUNG_API void writeFile(const std::filesystem::path& file, std::string_view text);

}  // namespace ortung
