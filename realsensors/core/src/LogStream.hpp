#pragma once

#include <boost/iostreams/filtering_stream.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>

namespace ortung {

/// Bytes of a file, decompressed as its name says, with a limit.
class LogStream {
 public:
  LogStream(const std::filesystem::path& path, std::uint64_t maxBytes);
  /// Fills @p buffer; 0 at the end.
  /// @throws std::runtime_error for damaged or cut off compression, and beyond the limit
  std::size_t read(char* buffer, std::size_t size);

 private:
  std::filesystem::path path_;
  std::uint64_t left_;
  std::uint64_t limit_;
  std::ifstream in_;
  boost::iostreams::filtering_istream out_;  // after in_: it reads from it until it is gone
};

}  // namespace ortung
