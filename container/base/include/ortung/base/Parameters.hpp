#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "ortung/base/Export.hpp"

namespace ortung {

/// Thrown for a setting that is missing, of the wrong kind, out of its range or not known.
/// The message says where (file, line, key), what was found and what was expected.
class ORTUNG_API ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ~ConfigError() override;
};

/// Permitted values of a number, both ends included.
struct Range {
  /// least permitted value
  double low = -std::numeric_limits<double>::infinity();
  /// greatest permitted value
  double high = std::numeric_limits<double>::infinity();
};

/// What a reader asked a table for: what may be there, for schemas and templates.
struct Question {
  enum class Kind { kFlag, kInteger, kNumber, kText, kNumbers, kTexts, kTable, kTables };
  Kind kind = Kind::kText;
  Range range;                          ///< bounds of a number, or of each one of a list
  int count = -1;                       ///< how many numbers a list has; -1: any number
  std::vector<std::string> choices;     ///< the only texts that are permitted; empty: any
  std::optional<std::string> fallback;  ///< what holds without the key, as TOML; nothing: required
};

/// Settings of one plugin or one part of a file: a table of keys with numbers, texts, flags, lists
/// and further tables. Keys end in their unit: "max_range_m", "fov_deg".
/// It remembers which keys were read, so that a misspelt key shows. Copies share their values.
/// Not thread-safe.
class ORTUNG_API Parameters {
 public:
  struct Node;  ///< one value with its place in the file
  using List = std::vector<Node>;

  /// Makes an empty table. @param where what errors call it, e.g. "robots/pioneer.toml"
  explicit Parameters(std::string where = "");

  /// Sets a value, or replaces it.
  void set(const std::string& key, bool value);
  void set(const std::string& key, double value);
  void set(const std::string& key, const char* value);
  void set(const std::string& key, const std::string& value);
  void set(const std::string& key, const std::vector<double>& values);
  void set(const std::string& key, Node value);

  bool has(const std::string& key) const;
  std::vector<std::string> keys() const;  ///< keys of this table in alphabetical order

  // The getters below throw ConfigError if the value is missing (except those with a fallback), of
  // another kind, or out of its range.
  /// Returns a finite number within @p range. @throws ConfigError
  double number(const std::string& key, const Range& range = {}) const;
  /// Returns the number, or @p fallback if the key is missing. @throws ConfigError
  double numberOr(const std::string& key, double fallback, const Range& range = {}) const;
  /// Returns a whole number within @p range. @throws ConfigError
  std::int64_t integer(const std::string& key, const Range& range = {}) const;
  std::int64_t integerOr(const std::string& key, std::int64_t fallback,
                         const Range& range = {}) const;
  std::string text(const std::string& key) const;
  std::string textOr(const std::string& key, const std::string& fallback) const;
  /// Returns one of @p choices, or @p fallback if the key is missing. @throws ConfigError listing
  /// them
  std::string choiceOr(const std::string& key, const std::string& fallback,
                       const std::vector<std::string>& choices) const;
  bool flagOr(const std::string& key, bool fallback) const;
  /// Returns a list of finite numbers within @p range; @p count of them, or any number if it is -1.
  /// @throws ConfigError
  std::vector<double> numbers(const std::string& key, int count = -1,
                              const Range& range = {}) const;
  std::vector<double> numbersOr(const std::string& key, const std::vector<double>& fallback,
                                int count = -1, const Range& range = {}) const;
  std::vector<std::string> texts(const std::string& key) const;
  /// Returns the table @p key; an empty one if it is missing (has() tells that apart).
  Parameters table(const std::string& key) const;
  /// The same for another reader, which checks it: refuseUnread() here no longer looks into it.
  Parameters takeTable(const std::string& key) const;
  /// Returns the tables of an array of tables, none if it is missing.
  std::vector<Parameters> tables(const std::string& key) const;

  /// Throws a ConfigError that names the place of @p key.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  /// @throws ConfigError naming the first key that was never read, here or in a table that was read
  void refuseUnread() const;
  const std::string& where() const;  ///< file or other origin, as errors call it

  /// From now on this table, and tables that are read from it, remember what they are asked.
  void survey();
  /// Returns what readers asked this table for since survey(), by key, whether or not it is there;
  /// keys of which they only asked whether they exist are not among it.
  std::map<std::string, Question> questions() const;
  /// Returns the tables under a key that readers asked for since survey(), with the questions that
  /// were put to them; an empty one each time that a table was not there.
  std::vector<Parameters> askedTables(const std::string& key) const;

 private:
  struct Table;
  const Node* look(const std::string& key) const;
  const Node& need(const std::string& key) const;
  void note(const std::string& key, Question question) const;
  void keepAsked(const std::string& key, const std::vector<Parameters>& tables) const;
  double toNumber(const std::string& key, const Node& node, const Range& range) const;
  std::shared_ptr<Table> table_;
};

/// One value with its place in the file.
struct Parameters::Node {
  std::variant<bool, std::int64_t, double, std::string, List, Parameters> value;
  int line = 0;  ///< line of the file, from 1; 0: the value is not from a file
};

}  // namespace ortung
