#include "TomlChanges.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "TomlLibrary.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung {
namespace {

namespace fs = std::filesystem;

/// A changed value, by the words of its key.
struct Change {
  std::vector<std::string> path;
  std::string value;
};

struct Changes {
  std::mutex mutex;
  std::map<fs::path, std::vector<Change>> files;
};

Changes& changes() {
  static Changes instance;
  return instance;
}

fs::path placeOf(const fs::path& file) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(file, error);
  return error ? file : place;
}

std::vector<std::string> wordsOf(const std::string& key) {
  std::vector<std::string> words;
  std::istringstream rest(key);
  for (std::string word; std::getline(rest, word, '.');) words.push_back(word);
  if (words.empty() || key.back() == '.' ||
      std::find(words.begin(), words.end(), "") != words.end())
    throw ConfigError("the key '" + key + "' is no path, expected one like mcl.particles");
  return words;
}

/// Returns the TOML of one value as a table with it; nothing if it is no TOML.
std::optional<toml::table> parsedValue(const std::string& value) {
  try {
    toml::table parsed = toml::parse("value = " + value);
    if (parsed.size() == 1) return parsed;
    return std::nullopt;  // it would bring further keys
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

/// Sets a value of a table. What is no TOML is a text.
void set(toml::table& table, const std::string& key, const std::string& value) {
  std::optional<toml::table> parsed = parsedValue(value);
  if (!parsed) {
    table.insert_or_assign(key, value);
    return;
  }
  parsed->get("value")->visit([&](auto& node) { table.insert_or_assign(key, std::move(node)); });
}

/// Returns whether a word means that table of a list.
bool isMeant(const toml::table& table, std::size_t number, const std::string& word) {
  static constexpr std::array<const char*, 3> kNames = {"plugin", "model", "type"};
  return word == std::to_string(number) || std::ranges::any_of(kNames, [&](const char* name) {
           return table[name].value<std::string>() == word;
         });
}

void apply(toml::table& table, std::span<const std::string> path, const Change& change,
           const std::string& file);

void applyToList(toml::array& list, std::span<const std::string> path, const Change& change,
                 const std::string& file) {
  bool isAny = false;
  for (std::size_t i = 0; i < list.size() && path.size() > 1; ++i) {
    toml::table* one = list[i].as_table();
    if (one == nullptr || !isMeant(*one, i + 1, path.front())) continue;
    apply(*one, path.subspan(1), change, file);
    isAny = true;
  }
  if (!isAny)
    throw ConfigError(file + ": has no [[...]] that '" + path.front() +
                      "' means, expected its number, plugin, model or type");
}

/// @param path the words of the key that are left
void apply(toml::table& table, std::span<const std::string> path, const Change& change,
           const std::string& file) {
  if (path.size() == 1) return set(table, path.front(), change.value);
  toml::node* node = table.get(path.front());
  if (node == nullptr) {
    table.insert(path.front(), toml::table());
    node = table.get(path.front());
  }
  if (toml::array* list = node->as_array())
    return applyToList(*list, path.subspan(1), change, file);
  toml::table* inner = node->as_table();
  if (inner == nullptr)
    throw ConfigError(file + ": " + path.front() + " is a value, expected a table");
  apply(*inner, path.subspan(1), change, file);
}

std::string withChanges(const std::string& text, const std::vector<Change>& all,
                        const std::string& file) {
  parseToml(text, file);  // within its bounds, and with its messages
  toml::table table = toml::parse(text);
  for (const Change& change : all) apply(table, change.path, change, file);
  std::ostringstream out;
  out << toml::toml_formatter(table) << '\n';
  return out.str();
}

}  // namespace

void changeToml(const fs::path& file, const std::string& key, const std::string& value) {
  const Change change{wordsOf(key), value};
  const std::string text = readUnchanged(file);
  const std::lock_guard lock(changes().mutex);
  const auto known = changes().files.find(placeOf(file));
  std::vector<Change> all = known == changes().files.end() ? std::vector<Change>() : known->second;
  all.push_back(change);
  withChanges(text, all, file.string());  // throws if that is not possible
  changes().files[placeOf(file)] = std::move(all);
}

std::string changedToml(std::string text, const fs::path& file) {
  const std::lock_guard lock(changes().mutex);
  if (changes().files.empty()) return text;
  const auto found = changes().files.find(placeOf(file));
  return found == changes().files.end() ? text : withChanges(text, found->second, file.string());
}

}  // namespace ortung
