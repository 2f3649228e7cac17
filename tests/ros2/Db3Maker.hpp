#pragma once

/// Files of rosbag2's storage `sqlite3`, for tests.

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace ortung::testing {

/// Writes such a file message by message.
class Db3Maker {
 public:
  explicit Db3Maker(const std::filesystem::path& file) {
    std::filesystem::remove(file);
    sqlite3* made = nullptr;
    EXPECT_EQ(sqlite3_open(file.c_str(), &made), SQLITE_OK);
    base_.reset(made);
  }
  Db3Maker& run(const std::string& sql) {
    EXPECT_EQ(sqlite3_exec(base_.get(), sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(base_.get());
    return *this;
  }
  /// Makes the tables of rosbag2.
  Db3Maker& tables() {
    return run(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC); BEGIN");
  }
  Db3Maker& add(const std::string& topic, std::string_view type, const std::string& bytes) {
    const auto [found, isNew] = topics_.emplace(topic, topics_.size() + 1);
    const std::string id = std::to_string(found->second);
    if (isNew)
      run("INSERT INTO topics VALUES (" + id + ", '" + topic + "', '" + std::string(type) +
          "', 'cdr', '')");
    sqlite3_stmt* made = nullptr;
    const std::string sql =
        "INSERT INTO messages(topic_id, timestamp, data) VALUES (" + id + ", 1, ?)";
    EXPECT_EQ(sqlite3_prepare_v2(base_.get(), sql.c_str(), -1, &made, nullptr), SQLITE_OK);
    const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement(made, sqlite3_finalize);
    sqlite3_bind_blob(made, 1, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
    EXPECT_EQ(sqlite3_step(made), SQLITE_DONE);
    return *this;
  }
  void finish() { run("COMMIT"); }

 private:
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> base_{nullptr, sqlite3_close};
  std::map<std::string, std::size_t> topics_;
};

}  // namespace ortung::testing
