#include "BagFile.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "../src/Compression.hpp"
#include "Db3File.hpp"
#include "Ros1File.hpp"
#include "ortung/base/InputFile.hpp"

namespace ortung::ros2 {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostWhole = std::size_t{1} << 30;  // bytes of a file compressed as a whole
constexpr const char* kRobotFile = "robot.toml";
constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";
constexpr std::string_view kMcapMagic = "\x89MCAP";

/// An MCAP file.
class McapFile : public BagFile {
 public:
  McapFile(std::unique_ptr<std::istream> file, const std::string& name)
      : file_(std::move(file)), reader_(*file_, name) {}
  bool next(McapMessage& message) override { return reader_.next(message); }
  bool isUnfinished() const override { return reader_.isUnfinished(); }
  std::string robotToml() const override {
    const auto found = reader_.attachments().find(kRobotFile);
    return found == reader_.attachments().end() ? "" : found->second;
  }

 private:
  std::unique_ptr<std::istream> file_;
  McapReader reader_;
};

std::string beginningOf(std::istream& in) {
  std::string bytes(kSqliteMagic.size(), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  in.clear();
  in.seekg(0);
  return bytes;
}

/// Opens a file of messages that is read as a stream; nothing for another beginning.
std::unique_ptr<BagFile> openStream(std::unique_ptr<std::istream> in, const std::string& name,
                                    std::string_view beginning) {
  if (beginning.starts_with(kMcapMagic)) return std::make_unique<McapFile>(std::move(in), name);
  if (beginning.starts_with(kRos1Magic)) return std::make_unique<Ros1File>(std::move(in), name);
  throw std::runtime_error(name +
                           ": found another beginning at byte 0, expected that of an MCAP file of "
                           "version 0, of a .db3 file of SQLite 3 or of a .bag file of ROS 1");
}

std::string unpackedFile(std::istream& in, const std::string& name) {
  in.seekg(0, std::ios::end);
  const std::streamoff size = in.tellg();
  in.seekg(0);
  const auto tooBig = [&](const std::string& what) {
    return std::runtime_error(name + ": found " + what +
                              ", expected 1 GiB at most; `zstd -d` unpacks it");
  };
  if (size < 0 || static_cast<std::uint64_t>(size) > kMostWhole)
    throw tooBig("a compressed file of " + std::to_string(size) + " bytes");
  std::string packed(static_cast<std::size_t>(size), '\0');
  if (!in.read(packed.data(), size)) throw std::runtime_error(name + ": can't be read to its end");
  std::string bytes;
  const std::string why = unpackZstd(packed, kMostWhole + 1, bytes);
  if (bytes.size() > kMostWhole) throw tooBig("a compressed file of more");
  if (!why.empty())
    throw std::runtime_error(name + ": found a file compressed by zstd that " + why +
                             ", expected a sound one");
  return bytes;
}

}  // namespace

BagFile::~BagFile() = default;

bool UnpackedSize::add(std::uint64_t packed, std::uint64_t unpacked) {
  packed_ += packed;
  unpacked_ += unpacked;
  return unpacked_ <= kMostAtFirst + kMostGain * packed_;
}

bool isZstd(std::string_view bytes) { return bytes.starts_with(kZstdMagic); }

std::unique_ptr<BagFile> openBagFile(const fs::path& file) {
  const std::string name = file.string();
  std::string why;
  auto in = std::make_unique<std::ifstream>(openInput(file, why));
  if (!*in) throw std::runtime_error(name + ": " + why);
  const std::string beginning = beginningOf(*in);
  if (beginning == kSqliteMagic) return std::make_unique<Db3File>(file);
  if (!isZstd(beginning)) return openStream(std::move(in), name, beginning);
  std::string bytes = unpackedFile(*in, name);
  if (bytes.starts_with(kSqliteMagic)) return std::make_unique<Db3File>(std::move(bytes), name);
  const std::string inner = bytes.substr(0, kSqliteMagic.size());
  return openStream(std::make_unique<std::istringstream>(std::move(bytes)), name, inner);
}

}  // namespace ortung::ros2
