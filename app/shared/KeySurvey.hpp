#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "ortung/base/Parameters.hpp"

namespace ortung::app {

/// The keys of a table, found out by asking its readers: so schemas, templates and tables of keys
/// can't differ from what is read.
struct KeySurvey {
  struct Key {
    std::optional<Question> question;  ///< nothing: a reader knows the key, but did not need it
    bool isRequired = false;           ///< whether each table that was read had to have it
  };
  std::map<std::string, Key> keys;
  std::map<std::string, KeySurvey> tables;    ///< those of tables within, by key
  std::map<std::string, KeySurvey> variants;  ///< those of tables with this `plugin`

  /// Adds the survey of further tables of this kind: what one of them does without is not required.
  void addTables(const KeySurvey& others);
  /// Adds the survey of another reader of the same tables: what it requires is required, too.
  void addReader(const KeySurvey& other);
};

/// Returns what was asked of a table, and of tables within it, since Parameters::survey(). The
/// table is not to be used any more.
KeySurvey surveyOf(const Parameters& table);

/// Finds the keys of a reader by letting it read tables: first an empty one, then what it missed.
/// @param read reads a table; a ConfigError says that something is wrong with it
KeySurvey surveyKeys(const std::function<void(const Parameters&)>& read);

/// Returns a value that may be there, as TOML: the default, or else one within the bounds.
std::string exampleOf(const Question& question);
/// Returns what may be there in words: "a number in [0, 1]", "one of rays, endpoints".
std::string textOf(const Question& question);

}  // namespace ortung::app
