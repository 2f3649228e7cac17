#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "Fields.hpp"

// Common Data Representation: OMG DDS-XTypes 1.3, section 7.4.3, encoding version 1 of plain types:
// every number is aligned to its size, counted from the end of the four bytes of the head.
namespace ortung::ros2 {

inline constexpr std::size_t kCdrHead = 4;

template <class T>
concept Number = std::is_arithmetic_v<T>;

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

/// Appends fields to a message. Not thread-safe.
class CdrWriter {
 public:
  CdrWriter() : bytes_("\0\1\0\0", kCdrHead) {}
  std::string take() { return std::move(bytes_); }

  void operator()(Number auto number) {
    align(sizeof number);
    append(&number, sizeof number);
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint32_t>(text.size() + 1));
    append(text.c_str(), text.size() + 1);
  }
  template <Number T, std::size_t N>
  void operator()(const std::array<T, N>& numbers) {
    align(sizeof(T));
    append(numbers.data(), N * sizeof(T));
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(static_cast<std::uint32_t>(list.size()));
    if constexpr (Number<T>) {
      if (list.empty()) return;
      align(sizeof(T));
      append(list.data(), list.size() * sizeof(T));
    } else {
      for (const T& one : list) (*this)(one);
    }
  }
  void time(std::int64_t stamp) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const std::int64_t seconds = stamp / kSecond - (stamp % kSecond < 0 ? 1 : 0);
    (*this)(static_cast<std::int32_t>(seconds));
    (*this)(static_cast<std::uint32_t>(stamp - seconds * kSecond));
  }
  template <class M>
    requires std::is_class_v<M>
  void operator()(const M& message) {
    fields(*this, message);
  }

 private:
  void align(std::size_t size) {
    bytes_.resize(kCdrHead + (bytes_.size() - kCdrHead + size - 1) / size * size);
  }
  void append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

/// Reads fields from bytes. The first one that is missing or invalid and all after it are
/// unchanged. Not thread-safe.
class CdrReader {
 public:
  explicit CdrReader(std::string_view bytes) {
    if (bytes.size() < kCdrHead) {
      fail("a message shorter than the head of CDR");
    } else if (bytes[0] != 0 || (bytes[1] != 0 && bytes[1] != 1)) {
      fail("a message whose head is not that of CDR of plain types (0 0 or 0 1)");
    } else {
      isSwapped_ = bytes[1] == 0;
      bytes_ = bytes.substr(kCdrHead);
    }
  }
  const std::string& why() const { return why_; }

  template <Number T>
  void operator()(T& number) {
    take(&number, 1);
  }
  void operator()(bool& flag) {  // a byte of any value: no bool may be made of its bits
    std::uint8_t byte = flag ? 1 : 0;
    take(&byte, 1);
    flag = byte != 0;
  }
  void operator()(std::string& text) {
    const std::uint32_t size = count(1);
    if (size == 0) return text.clear();  // some writers leave out the zero of an empty text
    if (bytes_[at_ + size - 1] != '\0') return fail("a text that does not end with a zero");
    text = bytes_.substr(at_, size - 1);
    at_ += size;
  }
  template <Number T, std::size_t N>
  void operator()(std::array<T, N>& numbers) {
    take(numbers.data(), N);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    if constexpr (Number<T>) {
      list.resize(count(sizeof(T)));
      take(list.data(), list.size());
    } else {
      constexpr std::size_t kLeastOfAnElement = std::is_same_v<T, std::string> ? 4 : 8;
      const std::uint32_t size = count(kLeastOfAnElement);
      list.clear();
      for (std::uint32_t i = 0; i < size && why_.empty(); ++i) (*this)(list.emplace_back());
    }
  }
  void time(std::int64_t& stamp) {
    std::int32_t seconds = 0;
    std::uint32_t rest = 0;
    (*this)(seconds);
    (*this)(rest);
    if (rest >= 1'000'000'000U) return fail("a time of more than 999999999 ns beside its seconds");
    stamp = std::int64_t{seconds} * 1'000'000'000 + rest;
  }
  template <class M>
    requires std::is_class_v<M>
  void operator()(M& message) {
    fields(*this, message);
  }

 private:
  /// Reads a number of elements; fails, and returns 0, if so many of @p size bytes can't follow.
  std::uint32_t count(std::size_t size) {
    std::uint32_t number = 0;
    take(&number, 1);
    if (!why_.empty()) return 0;
    if (number > (bytes_.size() - at_) / size) {
      fail("a list of " + std::to_string(number) + " elements in the last " +
           std::to_string(bytes_.size() - at_) + " bytes of a message");
      return 0;
    }
    return number;
  }
  template <Number T>
  void take(T* numbers, std::size_t count) {
    if (!why_.empty() || count == 0) return;
    const std::size_t from = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    if (from > bytes_.size() || count > (bytes_.size() - from) / sizeof(T))
      return fail("the end of a message within a field");
    std::memcpy(numbers, bytes_.data() + from, count * sizeof(T));
    at_ = from + count * sizeof(T);
    if (!isSwapped_ || sizeof(T) == 1) return;
    for (std::size_t i = 0; i < count; ++i) {
      auto* bytes = reinterpret_cast<char*>(numbers + i);
      std::reverse(bytes, bytes + sizeof(T));
    }
  }
  void fail(std::string found) {
    if (why_.empty()) why_ = "found " + std::move(found);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool isSwapped_ = false;
  std::string why_;
};

}  // namespace ortung::ros2
