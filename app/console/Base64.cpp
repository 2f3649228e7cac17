#include "Base64.hpp"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace ortung::app {

std::string base64(std::span<const std::byte> bytes) {
  using namespace boost::archive::iterators;
  using Encoder = base64_from_binary<transform_width<const char*, 6, 8>>;
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  std::string padded(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  padded.append(missing, '\0');  // the encoder reads whole groups of three
  std::string text(Encoder(padded.data()), Encoder(padded.data() + padded.size()));
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

}  // namespace ortung::app
