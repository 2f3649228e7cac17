#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace ortung::app {

/// A digest of bytes (XXH3, 128 bits), by which equal contents are recognized. It is fast, and no
/// protection against somebody who wants two files to look equal. Not thread-safe.
class ContentDigest {
 public:
  ContentDigest();
  ~ContentDigest();
  ContentDigest(const ContentDigest&) = delete;
  ContentDigest& operator=(const ContentDigest&) = delete;

  void add(std::span<const std::byte> bytes);
  /// Adds a text and its length, so that texts one after another do not run together.
  void add(std::string_view text);
  /// Returns the digest of what was added, as 32 hexadecimal digits.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the digest of a file's bytes. @throws std::runtime_error naming the file
std::string digestOfFile(const std::filesystem::path& file);

}  // namespace ortung::app
