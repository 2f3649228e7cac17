#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Thrown for a table file that can't be used; the message names the file, what was found and
/// expected.
class ORTUNG_API TableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~TableError() override;
};

enum class ElementType : std::uint8_t { kUint8, kUint16, kInt32, kFloat32, kFloat64 };

/// One array of a table file: row-major, little-endian, 64-byte aligned in the file.
struct TableArray {
  std::string name;
  ElementType type = ElementType::kUint8;
  std::vector<std::size_t> shape;
  std::span<const std::byte> bytes;
};

/// Writes a table file: a store-only zip of .npy arrays and meta.json, so `numpy.load` reads it.
/// An older file stays whole until commit() has put the new one in its place. Not thread-safe.
class ORTUNG_API TableWriter {
 public:
  explicit TableWriter(std::filesystem::path file);
  ~TableWriter();  ///< removes what was written, unless commit() came before
  TableWriter(const TableWriter&) = delete;
  TableWriter& operator=(const TableWriter&) = delete;

  /// Adds one array; its bytes are written at once. @p name of [A-Za-z0-9_.-], unique.
  template <class T>
  void add(const std::string& name, std::vector<std::size_t> shape, std::span<const T> values);
  void addBytes(const TableArray& array);

  /// Adds a text member, e.g. meta.json.
  void addText(const std::string& name, const std::string& text);

  /// Writes the directory, syncs and puts the file in its place. Returns how many bytes it has.
  /// @throws TableError
  std::uintmax_t commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A table file, memory-mapped and read-only; spans stay valid while it lives. Thread-safe:
/// immutable once made, but for what shared() keeps.
class ORTUNG_API TableFile {
 public:
  /// Maps the file and checks structure, sizes and checksums of all members.
  /// @throws TableError
  explicit TableFile(const std::filesystem::path& file);
  ~TableFile();
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;

  const std::filesystem::path& path() const;
  const std::vector<TableArray>& arrays() const;
  /// Returns the text member @p name. @throws TableError if it is missing
  std::string text(const std::string& name) const;

  /// Returns the array @p name as elements of T. @throws TableError if it is missing, of another
  /// type or does not have the shape @p shape (0 = any extent).
  template <class T>
  std::span<const T> get(const std::string& name, const std::vector<std::size_t>& shape) const;
  /// Returns the array @p name of any type and shape. @throws TableError if it is missing
  const TableArray& array(const std::string& name) const;

  /// Returns what @p make makes of the file's arrays; all who ask by the same name share it, as
  /// long as the file lives. @param make returns a std::shared_ptr<const T>, and asks for nothing
  /// shared; if it throws, nothing is kept
  template <class T, class Make>
  std::shared_ptr<const T> shared(const std::string& name, const Make& make) const {
    return std::static_pointer_cast<const T>(
        sharedOf(name, [&make] { return std::shared_ptr<const void>(make()); }));
  }

 private:
  struct Impl;
  std::shared_ptr<const void> sharedOf(
      const std::string& name, const std::function<std::shared_ptr<const void>()>& make) const;
  std::unique_ptr<Impl> impl_;
};

// --- templates -----------------------------------------------------------------------------
/// The ElementType of a C++ type.
template <class T>
struct ElementOf;
template <>
struct ElementOf<std::uint8_t> {
  static constexpr ElementType kType = ElementType::kUint8;
};
template <>
struct ElementOf<std::uint16_t> {
  static constexpr ElementType kType = ElementType::kUint16;
};
template <>
struct ElementOf<std::int32_t> {
  static constexpr ElementType kType = ElementType::kInt32;
};
template <>
struct ElementOf<float> {
  static constexpr ElementType kType = ElementType::kFloat32;
};
template <>
struct ElementOf<double> {
  static constexpr ElementType kType = ElementType::kFloat64;
};

/// Checks type and shape (0 = any extent) of an array. @throws TableError naming file and array
ORTUNG_API void checkArray(const TableFile& file, const TableArray& array, ElementType type,
                           const std::vector<std::size_t>& shape);

template <class T>
void TableWriter::add(const std::string& name, std::vector<std::size_t> shape,
                      std::span<const T> values) {
  addBytes({name, ElementOf<T>::kType, std::move(shape), std::as_bytes(values)});
}

template <class T>
std::span<const T> TableFile::get(const std::string& name,
                                  const std::vector<std::size_t>& shape) const {
  const TableArray& found = array(name);
  checkArray(*this, found, ElementOf<T>::kType, shape);
  return {reinterpret_cast<const T*>(found.bytes.data()), found.bytes.size() / sizeof(T)};
}

}  // namespace ortung
