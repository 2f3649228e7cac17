#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "Fields.hpp"

// Serialization of ROS 1 (wiki.ros.org/msg): numbers in little endian without alignment, texts and
// lists after their number of elements. Its messages have the fields of ROS 2's in the same order,
// but for a sequence number at the beginning of each header.
namespace ortung::ros2 {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

/// Removes the slash with which names of frames begin in older bags: ROS 2 has none.
inline void trimFrame(std::string& frame) {
  if (frame.starts_with('/')) frame.erase(0, 1);
}

/// Reads fields from untrusted bytes. The first one that is missing or invalid and all after it are
/// unchanged. Not thread-safe.
class Ros1Reader {
 public:
  explicit Ros1Reader(std::string_view bytes) : bytes_(bytes) {}
  const std::string& why() const { return why_; }

  template <class T>
    requires std::is_arithmetic_v<T>
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
    if (!why_.empty()) return;
    text = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
  }
  template <class T, std::size_t N>
  void operator()(std::array<T, N>& numbers) {
    take(numbers.data(), N);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    constexpr std::size_t kLeastOfAnElement = std::is_arithmetic_v<T> ? sizeof(T) : 8;
    const std::uint32_t size = count(kLeastOfAnElement);
    if constexpr (std::is_arithmetic_v<T>) {
      list.resize(size);
      take(list.data(), size);
    } else {
      list.clear();
      for (std::uint32_t i = 0; i < size && why_.empty(); ++i) (*this)(list.emplace_back());
    }
  }
  void time(std::int64_t& stamp) {
    std::uint32_t seconds = 0;
    std::uint32_t rest = 0;
    (*this)(seconds);
    (*this)(rest);
    if (rest >= 1'000'000'000U) return fail("a time of more than 999999999 ns beside its seconds");
    stamp = std::int64_t{seconds} * 1'000'000'000 + rest;
  }
  void operator()(Header& header) {
    std::uint32_t sequence = 0;
    (*this)(sequence);
    fields(*this, header);
    trimFrame(header.frame);
  }
  template <class M>
    requires std::is_class_v<M>
  void operator()(M& message) {
    fields(*this, message);
    if constexpr (requires { message.childFrame; }) trimFrame(message.childFrame);
  }

 private:
  /// Reads a number of elements; fails, and returns 0, if so many of @p size bytes can't follow.
  std::uint32_t count(std::size_t size) {
    std::uint32_t number = 0;
    take(&number, 1);
    if (!why_.empty()) return 0;
    if (number <= bytes_.size() / size) return number;
    fail("a list of " + std::to_string(number) + " elements in the last " +
         std::to_string(bytes_.size()) + " bytes of a message");
    return 0;
  }
  template <class T>
  void take(T* numbers, std::size_t count) {
    if (!why_.empty() || count == 0) return;
    if (count > bytes_.size() / sizeof(T)) return fail("the end of a message within a field");
    std::memcpy(numbers, bytes_.data(), count * sizeof(T));
    bytes_.remove_prefix(count * sizeof(T));
  }
  void fail(std::string found) {
    if (why_.empty()) why_ = "found " + std::move(found);
  }

  std::string_view bytes_;
  std::string why_;
};

}  // namespace ortung::ros2
