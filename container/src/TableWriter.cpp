#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <limits>
#include <set>

#include "Zip.hpp"
#include "ortung/container/TableFile.hpp"

namespace ortung {
namespace {

const char* descriptorOf(ElementType type) {
  static constexpr std::array<const char*, 5> kNames = {"|u1", "<u2", "<i4", "<f4", "<f8"};
  return kNames[static_cast<std::size_t>(type)];
}

/// Header of the .npy format, version 1.0, a multiple of 64 bytes long.
std::string npyHeader(const TableArray& array) {
  std::string shape;
  for (const std::size_t extent : array.shape) shape += std::to_string(extent) + ", ";
  if (array.shape.size() > 1) shape.resize(shape.size() - 2);
  if (array.shape.size() == 1) shape.pop_back();
  const std::string text = "{'descr': '" + std::string(descriptorOf(array.type)) +
                           "', 'fortran_order': False, 'shape': (" + shape + "), }";
  const std::size_t total = (10 + text.size() + 1 + 63) / 64 * 64;
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>((total - 10) & 0xFF);
  out += static_cast<char>((total - 10) >> 8);
  out += text;
  out.append(total - 1 - out.size(), ' ');
  return out + '\n';
}

}  // namespace

struct TableWriter::Impl {
  std::filesystem::path file;
  std::filesystem::path temporary;
  std::FILE* out = nullptr;
  std::uint64_t offset = 0;
  std::vector<zip::Member> members;
  std::set<std::string> names;

  void put(const void* bytes, std::size_t size) {
    if (size > 0 && std::fwrite(bytes, 1, size, out) != size) {
      throw TableError(file.string() + ": writing failed (is the disk full?)");
    }
    offset += size;
  }
  void add(const std::string& name, const std::string& header, std::span<const std::byte> bytes) {
    if (!names.insert(name).second) throw TableError(file.string() + ": member " + name + " is written twice");
    if (names.size() > zip::kMostMembers) throw TableError(file.string() + ": more than 65535 tables");
    if (name.size() > zip::kLongestName) throw TableError(file.string() + ": the name " + name + " is too long");
    const std::uint64_t size = header.size() + bytes.size();
    if (offset + size > std::numeric_limits<std::uint32_t>::max() - (1u << 20)) {
      throw TableError(file.string() + ": tables of more than 4 GiB; choose larger cells or fewer directions");
    }
    const std::uint32_t crc = zip::crc32(bytes, zip::crc32(std::as_bytes(std::span(header))));
    const zip::Member member{name, crc, static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(offset)};
    const std::string local = zip::localHeader(member);
    put(local.data(), local.size());
    put(header.data(), header.size());
    put(bytes.data(), bytes.size());
    members.push_back(member);
  }
};

TableWriter::TableWriter(std::filesystem::path file) : impl_(std::make_unique<Impl>()) {
  impl_->file = std::move(file);
  impl_->temporary = impl_->file;
  impl_->temporary += ".part" + std::to_string(::getpid());
  impl_->out = std::fopen(impl_->temporary.c_str(), "wbe");
  if (impl_->out == nullptr) throw TableError(impl_->file.string() + ": can't be written");
}

TableWriter::~TableWriter() {
  if (impl_->out == nullptr) return;
  std::fclose(impl_->out);
  std::error_code ignored;
  std::filesystem::remove(impl_->temporary, ignored);
}

void TableWriter::addBytes(const TableArray& array) {
  impl_->add(array.name + ".npy", npyHeader(array), array.bytes);
}

void TableWriter::addText(const std::string& name, const std::string& text) {
  impl_->add(name, "", std::as_bytes(std::span(text)));
}

void TableWriter::commit() {
  const std::string directory = zip::directory(impl_->members, static_cast<std::uint32_t>(impl_->offset));
  impl_->put(directory.data(), directory.size());
  const bool flushed = std::fflush(impl_->out) == 0 && ::fsync(::fileno(impl_->out)) == 0;
  if (!flushed) throw TableError(impl_->file.string() + ": writing failed (is the disk full?)");
  std::fclose(impl_->out);
  impl_->out = nullptr;
  std::error_code problem;
  std::filesystem::rename(impl_->temporary, impl_->file, problem);
  if (problem) {
    std::error_code ignored;
    std::filesystem::remove(impl_->temporary, ignored);
    throw TableError(impl_->file.string() + ": can't be put in place: " + problem.message());
  }
  const std::filesystem::path folder = impl_->file.parent_path();
  const int handle = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle >= 0) {
    ::fsync(handle);
    ::close(handle);
  }
}

}  // namespace ortung
