#include "ortung/tables/TableFile.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>

#include "Zip.hpp"
#include "ortung/base/FileKind.hpp"
#include "ortung/base/InputFile.hpp"

namespace ortung {
namespace {

constexpr std::size_t kMostDimensions = 8;

struct Kind {
  std::string_view descriptor;
  std::size_t size;
};
constexpr std::array<Kind, 5> kKinds = {
    {{"|u1", 1}, {"<u2", 2}, {"<i4", 4}, {"<f4", 4}, {"<f8", 8}}};

/// Moves @p rest behind @p expected; returns false if it does not begin with it.
bool skip(std::string_view& rest, std::string_view expected) {
  if (!rest.starts_with(expected)) return false;
  rest.remove_prefix(expected.size());
  return true;
}

std::optional<std::vector<std::size_t>> parseShape(std::string_view& rest) {
  std::vector<std::size_t> shape;
  while (!skip(rest, ")")) {
    std::size_t extent = 0;
    const auto result = std::from_chars(rest.data(), rest.data() + rest.size(), extent);
    if (result.ec != std::errc() || shape.size() == kMostDimensions) return std::nullopt;
    rest.remove_prefix(static_cast<std::size_t>(result.ptr - rest.data()));
    shape.push_back(extent);
    skip(rest, ",");
    skip(rest, " ");
  }
  return shape;
}

/// Returns the number of bytes of an array, or nothing if that overflows.
std::optional<std::size_t> bytesOf(const std::vector<std::size_t>& shape, std::size_t size) {
  for (const std::size_t extent : shape) {
    if (__builtin_mul_overflow(size, extent, &size)) return std::nullopt;
  }
  return size;
}

/// Reads a .npy member as TableWriter writes it.
std::optional<TableArray> parseNpy(const zip::Entry& entry) {
  const std::string_view all(reinterpret_cast<const char*>(entry.bytes.data()), entry.bytes.size());
  if (all.size() < 64 || all.substr(0, 8) != std::string_view("\x93NUMPY\x01\x00", 8))
    return std::nullopt;
  const std::size_t header =
      10u + static_cast<unsigned char>(all[8]) + 256u * static_cast<unsigned char>(all[9]);
  if (header > all.size() || header % 64 != 0) return std::nullopt;
  std::string_view rest = all.substr(10, header - 10);
  if (!skip(rest, "{'descr': '")) return std::nullopt;
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(),
                                 [&](const Kind& k) { return skip(rest, k.descriptor); });
  if (kind == kKinds.end() || !skip(rest, "', 'fortran_order': False, 'shape': ("))
    return std::nullopt;
  auto shape = parseShape(rest);
  if (!shape || !skip(rest, ", }")) return std::nullopt;
  const auto size = bytesOf(*shape, kind->size);
  if (!size || *size != all.size() - header) return std::nullopt;
  const std::string name = entry.name.substr(0, entry.name.size() - 4);
  return TableArray{name, static_cast<ElementType>(kind - kKinds.begin()), std::move(*shape),
                    entry.bytes.subspan(header)};
}

std::string shapeText(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t extent : shape) {
    text +=
        (text.empty() ? "" : " x ") + (extent == 0 ? std::string("any") : std::to_string(extent));
  }
  return text;
}

}  // namespace

TableError::~TableError() = default;

struct TableFile::Impl {
  std::filesystem::path path;
  std::span<const std::byte> bytes;
  std::vector<zip::Entry> texts;
  std::vector<TableArray> arrays;
  std::mutex mutex;  ///< guards what is made of the arrays
  std::map<std::string, std::shared_ptr<const void>> made;

  ~Impl() {
    if (!bytes.empty()) ::munmap(const_cast<std::byte*>(bytes.data()), bytes.size());
  }
  void map() {
    noteInput(path);
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    int error = file < 0 ? errno : 0;
    struct stat status{};
    if (file >= 0 && ::fstat(file, &status) != 0) error = errno;
    if (error == 0 && S_ISDIR(status.st_mode)) error = EISDIR;
    if (error == 0 && !S_ISREG(status.st_mode)) error = ENODEV;  // it can't be mapped
    const bool fine = error == 0;
    void* address = MAP_FAILED;
    if (fine && status.st_size > 0) {
      address = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE,
                       file, 0);
    }
    if (file >= 0) ::close(file);
    if (!fine) throw TableError(path.string() + ": " + cantBeRead(error));
    if (address == MAP_FAILED) throw TableError(path.string() + ": is empty or can't be mapped");
    bytes = {static_cast<const std::byte*>(address), static_cast<std::size_t>(status.st_size)};
  }
};

TableFile::TableFile(const std::filesystem::path& file) : impl_(std::make_unique<Impl>()) {
  impl_->path = file;
  impl_->map();
  std::vector<zip::Entry> entries;
  if (const std::string why = zip::read(impl_->bytes, entries); !why.empty()) {
    if (const std::string other = whatItIs(file, {FileKind::kTables, FileKind::kZip});
        !other.empty())
      throw TableError(file.string() + ": is no table file" + other);
    throw TableError(file.string() + ": is torn or no table file: " + why);
  }
  for (const zip::Entry& entry : entries) {
    if (!entry.name.ends_with(".npy")) {
      impl_->texts.push_back(entry);
      continue;
    }
    if (reinterpret_cast<std::uintptr_t>(entry.bytes.data()) % zip::kAlignment != 0) {
      throw TableError(file.string() + ": member " + entry.name + " is not aligned to 64 bytes");
    }
    auto array = parseNpy(entry);
    if (!array)
      throw TableError(file.string() + ": member " + entry.name +
                       " is no array of a kind that is used here");
    impl_->arrays.push_back(std::move(*array));
  }
}

TableFile::~TableFile() = default;

const std::filesystem::path& TableFile::path() const { return impl_->path; }
const std::vector<TableArray>& TableFile::arrays() const { return impl_->arrays; }

std::string TableFile::text(const std::string& name) const {
  for (const zip::Entry& entry : impl_->texts) {
    if (entry.name == name) {
      return {reinterpret_cast<const char*>(entry.bytes.data()), entry.bytes.size()};
    }
  }
  throw TableError(impl_->path.string() + ": has no member " + name + ", so it is no table file");
}

const TableArray& TableFile::array(const std::string& name) const {
  const auto it = std::find_if(impl_->arrays.begin(), impl_->arrays.end(),
                               [&](const TableArray& array) { return array.name == name; });
  if (it == impl_->arrays.end()) throw TableError(impl_->path.string() + ": has no table " + name);
  return *it;
}

/// Who asks for what another thread makes waits for it.
std::shared_ptr<const void> TableFile::sharedOf(
    const std::string& name, const std::function<std::shared_ptr<const void>()>& make) const {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->made.find(name);
  if (found != impl_->made.end()) return found->second;
  return impl_->made.emplace(name, make()).first->second;
}

void checkArray(const TableFile& file, const TableArray& array, ElementType type,
                const std::vector<std::size_t>& shape) {
  bool fits = array.shape.size() == shape.size();
  for (std::size_t i = 0; fits && i < shape.size(); ++i) {
    fits = shape[i] == 0 || shape[i] == array.shape[i];
  }
  if (!fits || array.type != type) {
    throw TableError(file.path().string() + ": table " + array.name + " has " +
                     std::string(kKinds[static_cast<std::size_t>(array.type)].descriptor) + " " +
                     shapeText(array.shape) + ", expected " +
                     std::string(kKinds[static_cast<std::size_t>(type)].descriptor) + " " +
                     shapeText(shape));
  }
}

}  // namespace ortung
