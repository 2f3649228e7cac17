#include <array>
#include <limits>
#include <set>

#include "Crc32.hpp"
#include "PluginProgress.hpp"
#include "Zip.hpp"
#include "ortung/base/NewFile.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {
namespace {

const char* descriptorOf(ElementType type) {
  static constexpr std::array<const char*, 5> kNames = {"|u1", "<u2", "<i4", "<f4", "<f8"};
  return kNames[static_cast<std::size_t>(type)];
}

/// Returns a header of the .npy format, version 1.0, a multiple of 64 bytes long.
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

/// Calls an action; an error of the file becomes one of tables.
template <class Action>
auto forTables(Action action) {
  try {
    return action();
  } catch (const std::runtime_error& error) {
    throw TableError(error.what());
  }
}

}  // namespace

struct TableWriter::Impl {
  explicit Impl(std::filesystem::path name) : file(std::move(name)), out(file) {}

  std::filesystem::path file;
  NewFile out;
  std::uint64_t offset = 0;
  std::vector<zip::Member> members;
  std::set<std::string> names;

  void put(std::span<const std::byte> bytes) {
    notePluginProgress();  // the player `learner` writes what may take long on a slow disk
    forTables([&] { out.write(bytes); });
    offset += bytes.size();
  }
  void put(std::string_view text) { put(std::as_bytes(std::span(text))); }
  void add(const std::string& name, const std::string& header, std::span<const std::byte> bytes) {
    if (!names.insert(name).second)
      throw TableError(file.string() + ": member " + name + " is written twice");
    if (names.size() > zip::kMostMembers)
      throw TableError(file.string() + ": more than 65535 tables");
    if (name.size() > zip::kLongestName)
      throw TableError(file.string() + ": the name " + name + " is too long");
    const std::uint64_t size = header.size() + bytes.size();
    if (offset + size > std::numeric_limits<std::uint32_t>::max() - (1u << 20)) {
      throw TableError(file.string() +
                       ": tables of more than 4 GiB; choose larger cells or fewer directions");
    }
    const std::uint32_t crc = zip::crc32(bytes, zip::crc32(std::as_bytes(std::span(header))));
    const zip::Member member{name, crc, static_cast<std::uint32_t>(size),
                             static_cast<std::uint32_t>(offset)};
    put(zip::localHeader(member));
    put(header);
    put(bytes);
    members.push_back(member);
  }
};

TableWriter::TableWriter(std::filesystem::path file)
    : impl_(forTables([&] { return std::make_unique<Impl>(std::move(file)); })) {}

TableWriter::~TableWriter() = default;

void TableWriter::addBytes(const TableArray& array) {
  impl_->add(array.name + ".npy", npyHeader(array), array.bytes);
}

void TableWriter::addText(const std::string& name, const std::string& text) {
  impl_->add(name, "", std::as_bytes(std::span(text)));
}

std::uintmax_t TableWriter::commit() {
  impl_->put(zip::directory(impl_->members, static_cast<std::uint32_t>(impl_->offset)));
  forTables([&] { impl_->out.commit(); });
  return impl_->out.size();
}

}  // namespace ortung
