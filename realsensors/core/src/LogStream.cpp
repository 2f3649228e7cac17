#include "LogStream.hpp"

#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <stdexcept>

#include "ortung/base/InputFile.hpp"

namespace ortung {

LogStream::LogStream(const std::filesystem::path& path, std::uint64_t maxBytes)
    : path_(path), left_(maxBytes), limit_(maxBytes) {
  std::string why;
  in_ = openInput(path, why);
  if (!in_) throw std::runtime_error(path.string() + ": " + why);
  if (path.extension() == ".xz") out_.push(boost::iostreams::lzma_decompressor());
  if (path.extension() == ".gz") out_.push(boost::iostreams::gzip_decompressor());
  out_.push(in_);
}

std::size_t LogStream::read(char* buffer, std::size_t size) {
  out_.read(buffer, static_cast<std::streamsize>(size));
  const auto count = static_cast<std::size_t>(out_.gcount());
  if (out_.bad() || in_.bad()) {
    throw std::runtime_error(path_.string() +
                             ": found damaged or truncated data after decompressed byte " +
                             std::to_string(limit_ - left_ + count) + ", expected a whole file");
  }
  if (count > left_) {
    throw std::runtime_error(path_.string() + ": found more than " + std::to_string(limit_) +
                             " bytes (decompressed), expected no more");
  }
  left_ -= count;
  return count;
}

}  // namespace ortung
