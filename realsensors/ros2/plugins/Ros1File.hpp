#pragma once

#include <cstdint>
#include <istream>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "BagFile.hpp"

namespace ortung::ros2 {

inline constexpr std::string_view kRos1Magic = "#ROSBAG V";  ///< beginning of a bag of any version

/// A bag of ROS 1, format 2.0 (wiki.ros.org/Bags/Format/2.0): chunks that are packed by nothing,
/// bz2 or lz4; its index is not used, and may be missing. Topics get a slash at their beginning, as
/// ROS 2 has them. Not thread-safe.
class Ros1File : public BagFile {
 public:
  /// Reads the beginning of a file.
  /// @param name name of the file for errors
  /// @throws std::runtime_error if it does not begin like a bag of this format
  Ros1File(std::unique_ptr<std::istream> file, std::string name);

  bool next(McapMessage& message) override;
  bool isUnfinished() const override { return isCut_ || isWithoutIndex_; }

 private:
  /// A record: a header of fields, and data.
  struct Record {
    std::string_view header, data;
  };
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;
  bool read(std::string& bytes, std::uint64_t size);
  bool readSize(std::uint32_t& size);
  /// Reads the next record that is used, outside chunks; false at the end of the file.
  bool readRecord(Record& record);
  bool takeRecord(Record& record);
  std::string_view need(std::string_view header, std::string_view field, std::size_t size) const;
  /// Takes a record. @returns whether it is a message
  bool look(const Record& record, bool isInChunk, McapMessage& message);
  void takeBagHeader(std::string_view header);
  void takeConnection(const Record& record);
  void takeChunk(const Record& record);
  void takeMessage(const Record& record, McapMessage& message) const;

  std::unique_ptr<std::istream> file_;
  std::string name_;
  std::uint64_t size_ = 0;   ///< size of the file [bytes]
  std::uint64_t at_ = 0;     ///< number of bytes read
  std::uint64_t place_ = 0;  ///< place of the current record [bytes]
  std::string header_, data_, chunk_;
  std::string_view rest_;  ///< rest of the chunk
  std::map<std::uint32_t, McapChannel> channels_;
  UnpackedSize unpacked_;
  bool isCut_ = false;
  bool isWithoutIndex_ = true;
  bool isOver_ = false;
};

}  // namespace ortung::ros2
