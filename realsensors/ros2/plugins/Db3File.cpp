#include "Db3File.hpp"

#include <sqlite3.h>

#include <stdexcept>
#include <utility>

namespace ortung::ros2 {
namespace {

namespace fs = std::filesystem;

constexpr int kMostName = 4096;  // bytes of a topic or a type
constexpr std::size_t kMostTopics = 65536;
constexpr int kStepsAtOnce = 10'000;                 // of SQLite's machine
constexpr std::uint64_t kStepsAtFirst = 10'000'000;  // whatever the file's size
constexpr std::uint64_t kStepsOfAByte = 4;           // a row of 25 bytes takes some 8
constexpr std::uint64_t kLeastOfAMessage = 6;        // bytes: its cell and the pointer to it

/// Writes a path as the URI of a file that does not change.
std::string uriOf(const fs::path& file) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string uri = "file://";
  for (const char c : fs::absolute(file).string()) {
    const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || c == '/' || c == '.' || c == '-' || c == '_';
    const auto byte = static_cast<unsigned char>(c);
    uri += isPlain ? std::string(1, c) : std::string{'%', kDigits[byte / 16], kDigits[byte % 16]};
  }
  return uri + "?immutable=1";
}

/// Allows what reading two tables needs: files of others could have more done.
int allowed(void*, int action, const char*, const char*, const char*, const char*) {
  const bool isReading = action == SQLITE_SELECT || action == SQLITE_READ;
  return isReading ? SQLITE_OK : SQLITE_DENY;
}

}  // namespace

struct Db3File::Database {
  struct Close {
    void operator()(sqlite3* db) const { sqlite3_close_v2(db); }
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  std::unique_ptr<sqlite3, Close> db;
  std::unique_ptr<sqlite3_stmt, Close> statement;
  std::uint64_t size = 0;   ///< size of the file [bytes]
  std::uint64_t steps = 0;  ///< number of steps of SQLite's machine

  /// Ends what takes longer than any sound file of this size: damaged ones can repeat their pages.
  static int pause(void* database) {
    auto& self = *static_cast<Database*>(database);
    self.steps += kStepsAtOnce;
    return self.steps > kStepsAtFirst + kStepsOfAByte * self.size ? 1 : 0;
  }
  int prepare(const char* sql) {
    statement.reset();  // at first, for it would reset the error, too
    sqlite3_stmt* made = nullptr;
    const int result = sqlite3_prepare_v2(db.get(), sql, -1, &made, nullptr);
    statement.reset(made);
    return result;
  }
  int step() { return sqlite3_step(statement.get()); }
  std::string why() const { return db ? sqlite3_errmsg(db.get()) : "no memory"; }
  bool is(int column, int type) const {
    return sqlite3_column_type(statement.get(), column) == type;
  }
  std::int64_t number(int column) const { return sqlite3_column_int64(statement.get(), column); }
  /// Returns the bytes of a column, valid until the next step.
  std::string_view bytes(int column) const {
    const void* data = sqlite3_column_blob(statement.get(), column);
    const int count = sqlite3_column_bytes(statement.get(), column);
    if (data == nullptr || count <= 0) return {};
    return {static_cast<const char*>(data), static_cast<std::size_t>(count)};
  }
  /// Sets what files of others may not do.
  void restrict() {
    sqlite3_progress_handler(db.get(), kStepsAtOnce, pause, this);
    sqlite3_limit(db.get(), SQLITE_LIMIT_LENGTH, static_cast<int>(kMostBytes));
    sqlite3_limit(db.get(), SQLITE_LIMIT_SQL_LENGTH, 1 << 20);
    sqlite3_limit(db.get(), SQLITE_LIMIT_COLUMN, 64);
    sqlite3_limit(db.get(), SQLITE_LIMIT_EXPR_DEPTH, 64);
    for (const int off : {SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER,
                          SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION})
      sqlite3_db_config(db.get(), off, 0, nullptr);
    sqlite3_db_config(db.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    // Files may tell how much of them to keep in memory. Damage that these meet the next ones do.
    sqlite3_exec(db.get(),
                 "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0; PRAGMA cache_size = -8192",
                 nullptr, nullptr, nullptr);
    sqlite3_set_authorizer(db.get(), allowed, nullptr);
  }
};

Db3File::Db3File(const fs::path& file)
    : name_(file.string()), database_(std::make_unique<Database>()) {
  std::error_code none;
  database_->size = fs::file_size(file, none);
  const auto journal = fs::file_size(fs::path(name_ + "-wal"), none);
  isUnfinished_ = !none && journal > 0;
  sqlite3* made = nullptr;
  const int result = sqlite3_open_v2(
      uriOf(file).c_str(), &made,
      SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_PRIVATECACHE,
      nullptr);
  database_->db.reset(made);
  if (result != SQLITE_OK) fail(database_->why(), "a file of SQLite 3");
  open();
}

Db3File::Db3File(std::string bytes, std::string name)
    : name_(std::move(name)), bytes_(std::move(bytes)), database_(std::make_unique<Database>()) {
  constexpr std::size_t kJournalMode = 18;  // 2 here and behind means a journal beside the file
  for (std::size_t i = kJournalMode; i < kJournalMode + 2 && i < bytes_.size(); ++i)
    if (bytes_[i] == 2) bytes_[i] = 1;
  database_->size = bytes_.size();
  sqlite3* made = nullptr;
  int result =
      sqlite3_open_v2(":memory:", &made, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  database_->db.reset(made);
  if (result == SQLITE_OK)
    result =
        sqlite3_deserialize(made, "main", reinterpret_cast<unsigned char*>(bytes_.data()),
                            static_cast<sqlite3_int64>(bytes_.size()),
                            static_cast<sqlite3_int64>(bytes_.size()), SQLITE_DESERIALIZE_READONLY);
  if (result != SQLITE_OK) fail(database_->why(), "a file of SQLite 3");
  open();
}

Db3File::~Db3File() = default;

void Db3File::fail(const std::string& found, const std::string& expected) const {
  const std::string place = isOpen_ ? " at message " + std::to_string(messages_ + 1) : "";
  throw std::runtime_error(name_ + ": found " + found + place + ", expected " + expected);
}

void Db3File::open() {
  Database& db = *database_;
  db.restrict();
  // Tables that a file lets others compute have no page of their own.
  int tables = 0;
  int result = db.prepare(
      "SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND "
      "(name = 'topics' OR name = 'messages')");
  if (result == SQLITE_OK)
    while ((result = db.step()) == SQLITE_ROW) ++tables;
  if (result != SQLITE_DONE) fail("a database that is damaged (" + db.why() + ")", "a sound one");
  if (tables != 2) fail("no tables topics and messages", "those of rosbag2");
  readTopics();
  if (db.prepare("SELECT topic_id, timestamp, data FROM messages ORDER BY rowid") != SQLITE_OK)
    fail("another table of messages (" + db.why() + ")", "that of rosbag2");
  isOpen_ = true;
}

void Db3File::readTopics() {
  Database& db = *database_;
  if (db.prepare("SELECT id, name, type, serialization_format FROM topics") != SQLITE_OK)
    fail("another table of topics (" + db.why() + ")", "that of rosbag2");
  int result = SQLITE_DONE;
  while ((result = db.step()) == SQLITE_ROW) {
    for (const int column : {1, 2, 3})
      if (!db.is(column, SQLITE_TEXT) || db.bytes(column).size() > kMostName)
        fail("a topic whose name, type or format is no text of up to 4096 bytes", "one");
    if (!db.is(0, SQLITE_INTEGER)) fail("a topic without a number", "one");
    if (channels_.size() >= kMostTopics)
      fail("one more topic", std::to_string(kMostTopics) + " at most");
    McapChannel channel;
    channel.topic = db.bytes(1);
    channel.schema.name = db.bytes(2);
    channel.encoding = db.bytes(3);
    channels_.insert_or_assign(db.number(0), std::move(channel));
  }
  if (result != SQLITE_DONE) fail("topics that are damaged (" + db.why() + ")", "sound ones");
}

bool Db3File::next(McapMessage& message) {
  Database& db = *database_;
  if (!db.statement) return false;
  const int result = db.step();
  if (result == SQLITE_DONE) {
    db.statement.reset();
    return false;
  }
  if (result != SQLITE_ROW) fail("messages that are damaged (" + db.why() + ")", "sound ones");
  if (!db.is(0, SQLITE_INTEGER) || !db.is(1, SQLITE_INTEGER) || !db.is(2, SQLITE_BLOB))
    fail("a topic or time that is no number, or data that are no bytes", "those of a message");
  const auto channel = channels_.find(db.number(0));
  if (channel == channels_.end())
    fail("a message of topic " + std::to_string(db.number(0)), "a topic of the table");
  if (db.number(1) < 0)
    fail("a time of " + std::to_string(db.number(1)) + " ns", "0 or more since 1970");
  message.channel = &channel->second;
  message.logTime = static_cast<std::uint64_t>(db.number(1));
  message.data = db.bytes(2);
  spent_ += message.data.size() + kLeastOfAMessage;
  if (spent_ > db.size) fail("more messages than the file has bytes", "each of them once");
  ++messages_;
  return true;
}

}  // namespace ortung::ros2
