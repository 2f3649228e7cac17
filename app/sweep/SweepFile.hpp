#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ortung::app {

/// One task of a sweep: a command of the program, whose result is figures.
struct SweepTask {
  std::string id;                   ///< digest of its words: 16 hexadecimal digits
  std::string name;                 ///< its values, as "log=intel,seed=3"
  std::vector<std::string> words;   ///< command line behind "ortung", without --shard and outputs
  std::vector<std::string> values;  ///< name of each varied value, in the order of the keys
};

/// A value that a sweep gives to a key.
struct SweepValue {
  std::string name;
  bool isList = false;
  std::vector<std::string> words;                         ///< of a list
  std::map<std::string, std::string> fields;              ///< of a table; "": the value itself
  std::map<std::string, std::vector<std::string>> lists;  ///< fields of a table that are lists
};

/// A file that says what a command is run with: all combinations of some values. Immutable.
///
///   command = ["eval", "--source", "record:{log}.rec", "--seed", "{seed}", "{fault}", ...]
///   [vary]
///   log = ["intel", "aces"]
///   seed = "1..20"
///   fault = [[], ["--fault", "readings=crowd"]]
///
/// A value is a number, a text, a list of words (which a word that is nothing but the key stands
/// for), or a table with a `name` and fields ("{log.robot}"), each a number, a text or such a list.
/// Keys within values ("seed={seed}") are filled, too. Paths are relative to the file.
class SweepFile {
 public:
  /// @throws ConfigError naming file, key, what was found and expected
  explicit SweepFile(const std::filesystem::path& file);
  /// Reads a text. @param name what errors call it @param folder folder of relative paths
  SweepFile(std::string text, const std::string& name, std::filesystem::path folder);

  const std::string& text() const { return text_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<std::string>& keys() const { return keys_; }  ///< in the order of the file
  std::size_t size() const;                                       ///< number of tasks
  /// Returns a task. @pre index < size()
  SweepTask task(std::size_t index) const;
  /// Returns the names of a key's values in their order. @pre it is one of keys()
  std::vector<std::string> namesOf(const std::string& key) const;
  /// Returns the command's name: "eval" or "benchmark goalkeeper".
  const std::string& command() const { return command_; }

 private:
  void read(const std::string& name);
  void add(std::vector<std::string>& words, const std::string& pattern,
           const std::vector<const SweepValue*>& values) const;
  std::string filled(const std::string& pattern, const std::vector<const SweepValue*>& values,
                     int depth) const;
  const std::vector<std::string>* listOf(const std::string& pattern,
                                         const std::vector<const SweepValue*>& values) const;
  bool isUsed(const std::string& key) const;
  void checkUse(const std::string& name) const;

  std::string text_;
  std::filesystem::path folder_;
  std::string command_;
  std::vector<std::string> patterns_;
  std::vector<std::string> keys_;
  std::vector<std::vector<SweepValue>> values_;  ///< by key
};

}  // namespace ortung::app
