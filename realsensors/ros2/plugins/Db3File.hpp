#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "BagFile.hpp"

namespace ortung::ros2 {

inline constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

/// A file of rosbag2's storage `sqlite3` (.db3): messages in the order in which they were recorded.
/// It is opened so that nothing of it or beside it is written or locked. Not thread-safe.
class Db3File : public BagFile {
 public:
  /// @throws std::runtime_error if it is not such a file
  explicit Db3File(const std::filesystem::path& file);
  /// @param bytes the file's content
  /// @param name name of the file for errors
  Db3File(std::string bytes, std::string name);
  ~Db3File() override;

  bool next(McapMessage& message) override;
  bool isUnfinished() const override { return isUnfinished_; }

 private:
  struct Database;
  void open();
  void readTopics();
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

  std::string name_;
  std::string bytes_;  ///< content of a file that is in memory
  std::unique_ptr<Database> database_;
  std::map<std::int64_t, McapChannel> channels_;
  std::uint64_t messages_ = 0;  ///< number of messages read
  std::uint64_t spent_ = 0;     ///< the least space that these take in a sound file [bytes]
  bool isUnfinished_ = false;
  bool isOpen_ = false;  ///< whether messages are being read
};

}  // namespace ortung::ros2
