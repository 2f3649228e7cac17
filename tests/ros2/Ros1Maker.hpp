#pragma once

/// Bags of ROS 1 by their specification, for tests and fuzz targets.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "Fields.hpp"

namespace ortung::testing {

/// Appends the fields of a message as ROS 1 serializes them.
class Ros1Writer {
 public:
  template <class T>
    requires std::is_arithmetic_v<T>
  void operator()(T number) {
    append(&number, sizeof number);
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint32_t>(text.size()));
    bytes += text;
  }
  template <class T, std::size_t N>
  void operator()(const std::array<T, N>& numbers) {
    append(numbers.data(), sizeof numbers);
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(static_cast<std::uint32_t>(list.size()));
    for (const T& one : list) (*this)(one);
  }
  void time(std::int64_t stamp) {
    (*this)(static_cast<std::uint32_t>(stamp / 1'000'000'000));
    (*this)(static_cast<std::uint32_t>(stamp % 1'000'000'000));
  }
  void operator()(const ros2::Header& header) {
    (*this)(std::uint32_t{42});  // the sequence number, which ROS 2 has not
    fields(*this, header);
  }
  template <class M>
    requires std::is_class_v<M>
  void operator()(const M& message) {
    fields(*this, message);
  }
  std::string bytes;

 private:
  void append(const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  }
};

template <class M>
std::string toRos1(const M& message) {
  Ros1Writer writer;
  writer(message);
  return writer.bytes;
}

/// Writes the records of a bag.
class Ros1Maker {
 public:
  using Header = std::vector<std::pair<std::string, std::string>>;

  static std::string bytesOf(auto number) {
    return {reinterpret_cast<const char*>(&number), sizeof number};
  }
  static std::string record(const Header& header, std::string_view data) {
    std::string head;
    for (const auto& [name, value] : header)
      head +=
          bytesOf(static_cast<std::uint32_t>(name.size() + 1 + value.size())) + name + "=" + value;
    return bytesOf(static_cast<std::uint32_t>(head.size())) + head +
           bytesOf(static_cast<std::uint32_t>(data.size())) + std::string(data);
  }
  static std::string operation(char op) { return std::string(1, op); }
  static std::string bagHeader(std::uint64_t indexPlace = 13) {
    return record({{"op", operation(3)}, {"index_pos", bytesOf(indexPlace)}}, "padding");
  }
  static std::string chunkOf(const std::string& compression, std::size_t size,
                             std::string_view packed) {
    return record({{"op", operation(5)},
                   {"compression", compression},
                   {"size", bytesOf(static_cast<std::uint32_t>(size))}},
                  packed);
  }
  /// Adds a message, and its connection if its topic has none. @param type e.g. "tf/tfMessage"
  Ros1Maker& add(const std::string& topic, const std::string& type, std::string_view message) {
    const auto [found, isNew] =
        connections_.emplace(topic, static_cast<std::uint32_t>(connections_.size()));
    const std::string number = bytesOf(found->second);
    if (isNew) {
      std::string about;
      for (const std::string& field : {"topic=" + topic, "type=" + type})
        about += bytesOf(static_cast<std::uint32_t>(field.size())) + field;
      records += record({{"op", operation(7)}, {"conn", number}, {"topic", topic}}, about);
    }
    ++time_;
    records += record({{"op", operation(2)},
                       {"conn", number},
                       {"time", bytesOf(std::uint32_t{1}) + bytesOf(time_)}},
                      message);
    return *this;
  }
  std::string bag() const {
    return "#ROSBAG V2.0\n" + bagHeader() + chunkOf("none", records.size(), records);
  }
  std::string records;  ///< records of a chunk

 private:
  std::map<std::string, std::uint32_t> connections_;
  std::uint32_t time_ = 0;
};

}  // namespace ortung::testing
