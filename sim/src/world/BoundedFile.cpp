#include "BoundedFile.hpp"

#include <algorithm>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include "GridMap.hpp"
#include "ortung/base/InputFile.hpp"

namespace ortung {
namespace {

namespace io = boost::iostreams;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw MapError(file.string() + ": " + what);
}

std::string drain(const std::filesystem::path& file, std::streambuf& stream, std::size_t maxBytes) {
  std::string all;
  std::vector<char> block(std::size_t{1} << 16);
  for (;;) {
    const std::streamsize n =
        stream.sgetn(block.data(), static_cast<std::streamsize>(block.size()));
    if (n <= 0) return all;
    all.append(block.data(), static_cast<std::size_t>(n));
    if (all.size() > maxBytes)
      refuse(file,
             "unpacks to more than " + std::to_string(maxBytes) + " bytes, which is not read");
  }
}

}  // namespace

std::string readBounded(const std::filesystem::path& file, std::size_t maxBytes) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) refuse(file, "no such file");
  if (!std::filesystem::is_regular_file(status)) refuse(file, "is not a regular file");
  const auto size = std::filesystem::file_size(file, error);
  if (error) refuse(file, error.message());
  if (size > maxBytes)
    refuse(file,
           "has " + std::to_string(size) + " bytes, expected at most " + std::to_string(maxBytes));
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::string why;
  std::ifstream stream = openInput(file, why);
  if (!stream) refuse(file, why);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) refuse(file, cantBeRead(errno));
  return bytes;
}

std::string readUnpacked(const std::filesystem::path& file, std::size_t maxBytes) {
  std::string packed = readBounded(file, maxBytes);
  const std::string end = file.extension().string();
  if (end != ".gz" && end != ".xz") return packed;
  try {
    io::filtering_streambuf<io::input> stream;
    if (end == ".gz") stream.push(io::gzip_decompressor());
    if (end == ".xz") stream.push(io::lzma_decompressor());
    stream.push(io::array_source(packed.data(), packed.size()));
    return drain(file, stream, maxBytes);
  } catch (const MapError&) {
    throw;
  } catch (const std::exception& error) {  // thrown by Boost for corrupt and truncated files
    refuse(file, std::string("cannot be unpacked: ") + error.what());
  }
}

}  // namespace ortung
