#pragma once

#include <boost/iostreams/filtering_stream.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>

namespace ortung {

/// Reads the bytes of a file, decompressed as the name's ending says, up to a limit.
class LogStream {
 public:
  LogStream(const std::filesystem::path& path, std::uint64_t maxBytes);
  /// Fills @p buffer. @return the number of bytes; 0 at the end
  /// @throws std::runtime_error for damaged or truncated compression, and beyond the limit
  std::size_t read(char* buffer, std::size_t size);

 private:
  std::filesystem::path path_;
  std::uint64_t left_;
  std::uint64_t limit_;
  std::ifstream in_;
  boost::iostreams::filtering_istream out_;  // after in_: it reads from it until it is gone
};

}  // namespace ortung
