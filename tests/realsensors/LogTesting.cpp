#include "LogTesting.hpp"

#include <unistd.h>

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "Paths.hpp"
#include "ortung/core/PluginFactory.hpp"

namespace ortung::testing {
namespace {

template <class Filter>
std::string filtered(const std::string& text, const Filter& filter) {
  std::istringstream in(text);
  std::ostringstream out;
  boost::iostreams::filtering_ostream stream;
  stream.push(filter);
  stream.push(out);
  boost::iostreams::copy(in, stream);
  stream.reset();
  return out.str();
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "ortung-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name,
                                             const std::string& bytes) const {
  const auto file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

std::string compressedXz(const std::string& text) {
  return filtered(text, boost::iostreams::lzma_compressor());
}

std::string compressedGz(const std::string& text) {
  return filtered(text, boost::iostreams::gzip_compressor());
}

std::string readBytes(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

std::unique_ptr<Source> makeSource(const std::string& text) {
  static PluginFactory factory(PluginFactory::standardFolders());
  const SourceText parsed = parseSourceText(text);
  Parameters parameters(text);
  parameters.set("path", parsed.path);
  parameters.set("robot_file", "");
  for (const auto& [key, value] : parsed.options) parameters.set(key, value);
  return factory.make<Source>(parsed.kind, parameters);
}

std::vector<Message> readAll(Source& source) {
  std::vector<Message> messages;
  for (Message message; source.next(message);) messages.push_back(message);
  return messages;
}

std::vector<Message> readAll(const std::string& text) { return readAll(*makeSource(text)); }

std::vector<Message> only(const std::vector<Message>& messages, const std::string& id) {
  std::vector<Message> found;
  for (const Message& message : messages) {
    if (toText(message.id) == id) found.push_back(message);
  }
  return found;
}

std::vector<std::string> asText(const std::vector<Message>& messages) {
  std::vector<std::string> texts;
  for (const Message& message : messages) {
    std::string text = std::to_string(message.stamp) + " " + toText(message.id);
    for (const std::uint32_t word : message.words) text += " " + std::to_string(word);
    texts.push_back(text);
  }
  return texts;
}

std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

std::string errorOf(const std::string& source) {
  return errorOf([&] { readAll(source); });
}

std::string errorWith(const TemporaryFolder& folder, const std::string& name,
                      const std::string& bytes, const std::string& source) {
  const std::filesystem::path file = folder.path() / name;
  const bool isNew = !std::filesystem::exists(file);
  const std::string before = isNew ? "" : readBytes(file.string());
  folder.write(name, bytes);
  std::string error = errorOf(source);
  if (isNew)
    std::filesystem::remove(file);
  else
    folder.write(name, before);
  return error;
}

std::string mutated(const std::string& bytes, std::mt19937& random) {
  const std::string kTypical = "0 9.-+e\n\t#:nainf\xff";
  std::string result = bytes;
  for (unsigned i = 0; i < 1 + random() % 4 && !result.empty(); ++i) {
    const std::size_t at = random() % result.size();
    switch (random() % 5) {
      case 0:
        result[at] = static_cast<char>(random());
        break;
      case 1:
        result[at] = kTypical[random() % kTypical.size()];
        break;
      case 2:
        result.insert(at, 1 + random() % 3, kTypical[random() % kTypical.size()]);
        break;
      case 3:
        result.erase(at, 1 + random() % 20);
        break;
      default:
        result.resize(at);
        break;
    }
  }
  return result;
}

std::filesystem::path sharedData(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(ORTUNG_SHARED_DATA) / name;
  return std::filesystem::exists(path) ? path : std::filesystem::path();
}

}  // namespace ortung::testing
