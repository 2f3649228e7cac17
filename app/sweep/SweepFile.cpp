#include "SweepFile.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "ContentDigest.hpp"
#include "ortung/base/Parameters.hpp"
#include "ortung/robot/TomlFile.hpp"

namespace ortung::app {
namespace {

constexpr std::size_t kMostTasks = 10'000'000;
constexpr int kDeepest = 4;  ///< values within values
constexpr std::int64_t kLongestRange = 1'000'000;

[[noreturn]] void refuse(const std::string& file, const toml::node& node, const std::string& what) {
  throw ConfigError(fmt::format("{}:{}: {}", file, node.source().begin.line, what));
}

/// Returns a number or a text as a word. @param key what errors call it
std::string wordOf(const toml::node& node, const std::string& key, const std::string& file) {
  if (const auto* text = node.as_string()) return text->get();
  if (node.is_integer() || node.is_floating_point() || node.is_boolean()) {
    std::ostringstream out;
    node.visit([&](const auto& value) {
      if constexpr (toml::is_value<decltype(value)>) out << value.get();
    });
    return node.is_boolean() ? (node.as_boolean()->get() ? "true" : "false") : out.str();
  }
  refuse(file, node, key + ": expected a number or a text");
}

std::vector<std::string> wordsOf(const toml::array& list, const std::string& key,
                                 const std::string& file) {
  std::vector<std::string> words;
  for (const toml::node& node : list) words.push_back(wordOf(node, key, file));
  return words;
}

/// Reads "1..20". @returns whether it is a range
bool readRange(const std::string& text, std::int64_t& first, std::int64_t& last) {
  const std::size_t dots = text.find("..");
  if (dots == text.npos) return false;
  const char* const begin = text.data();
  const auto low = std::from_chars(begin, begin + dots, first);
  const auto high = std::from_chars(begin + dots + 2, begin + text.size(), last);
  return low.ec == std::errc() && low.ptr == begin + dots && high.ec == std::errc() &&
         high.ptr == begin + text.size() && first <= last && last - first < kLongestRange;
}

/// Reads one value of a list.
SweepValue valueIn(const toml::node& node, const std::string& key, const std::string& file) {
  SweepValue value;
  if (const toml::array* list = node.as_array()) {
    value.isList = true;
    value.words = wordsOf(*list, key, file);
    for (const std::string& word : value.words)
      value.name += (value.name.empty() ? "" : " ") + word;
    if (value.words.empty()) value.name = "none";
    return value;
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [name, content] : *table) {
      const std::string field(name.str());
      const std::string path = key + "." + field;
      if (const toml::array* list = content.as_array())
        value.lists[field] = wordsOf(*list, path, file);
      else
        value.fields[field] = wordOf(content, path, file);
    }
    value.name = value.fields["name"];
    if (value.name.empty()) refuse(file, node, key + ": a table needs a name");
  } else {
    value.name = wordOf(node, key, file);
  }
  value.fields[""] = value.name;
  return value;
}

/// Reads a list of values or a range; none if it is neither.
std::vector<SweepValue> valuesIn(const toml::node& node, const std::string& key,
                                 const std::string& file) {
  std::vector<SweepValue> values;
  std::int64_t first = 0;
  std::int64_t last = 0;
  if (node.is_string() && readRange(node.as_string()->get(), first, last)) {
    for (std::int64_t i = first; i <= last; ++i)
      values.push_back({std::to_string(i), false, {}, {{"", std::to_string(i)}}, {}});
  } else if (const toml::array* list = node.as_array()) {
    for (const toml::node& one : *list) values.push_back(valueIn(one, key, file));
  }
  return values;
}

}  // namespace

SweepFile::SweepFile(const std::filesystem::path& file)
    : SweepFile(readTomlText(file), file.string(), std::filesystem::absolute(file).parent_path()) {}

SweepFile::SweepFile(std::string text, const std::string& name, std::filesystem::path folder)
    : text_(std::move(text)), folder_(std::move(folder)) {
  parseToml(text_, name);  // within its bounds, and with its messages
  read(name);
  checkUse(name);
  std::size_t tasks = 1;
  for (const auto& values : values_) {
    tasks *= values.size();
    if (tasks > kMostTasks)
      throw ConfigError(fmt::format("{}: has more than {} tasks", name, kMostTasks));
  }
}

void SweepFile::read(const std::string& name) {
  const toml::table all = toml::parse(text_);
  for (const auto& [key, node] : all)
    if (key != "command" && key != "vary")
      refuse(name, node, fmt::format("'{}' is not known, expected command and [vary]", key.str()));
  const toml::array* command = all["command"].as_array();
  if (command == nullptr) throw ConfigError(name + ": has no list of words named command");
  patterns_ = wordsOf(*command, "command", name);
  const bool isMatrix =
      patterns_.size() > 1 && patterns_[0] == "benchmark" && patterns_[1] == "goalkeeper";
  if (!isMatrix && (patterns_.empty() || patterns_[0] != "eval"))
    refuse(name, *command, "expected a command with figures: eval, or benchmark goalkeeper");
  command_ = isMatrix ? "benchmark goalkeeper" : "eval";
  for (const char* own : {"--shard", "--json", "--report", "--html", "--record", "--view"})
    if (std::find(patterns_.begin(), patterns_.end(), own) != patterns_.end())
      refuse(name, *command, fmt::format("{} is the sweep's own", own));
  const toml::table* vary = all["vary"].as_table();
  if (vary == nullptr) return;
  // The library sorts by name; people order by meaning.
  std::vector<std::pair<toml::source_index, std::string>> order;
  for (const auto& [key, node] : *vary)
    order.emplace_back(node.source().begin.line, std::string(key.str()));
  std::sort(order.begin(), order.end());
  for (const auto& [line, key] : order) {
    const toml::node& node = *vary->get(key);
    std::vector<SweepValue> values = valuesIn(node, key, name);
    if (values.empty())
      refuse(name, node, key + ": expected a list of values, or a range as \"1..20\"");
    std::set<std::string> names;
    for (const SweepValue& value : values)
      if (!names.insert(value.name).second)
        refuse(name, node, fmt::format("{}: has the value '{}' twice", key, value.name));
    keys_.push_back(key);
    values_.push_back(std::move(values));
  }
}

/// Returns the list that a pattern stands for which is nothing but its key, or null.
const std::vector<std::string>* SweepFile::listOf(
    const std::string& pattern, const std::vector<const SweepValue*>& values) const {
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    if (values[k]->isList && pattern == "{" + keys_[k] + "}") return &values[k]->words;
    for (const auto& [field, words] : values[k]->lists)
      if (pattern == "{" + keys_[k] + "." + field + "}") return &words;
  }
  return nullptr;
}

/// Adds the words of a pattern. @throws std::out_of_range for a place that nothing fills
void SweepFile::add(std::vector<std::string>& words, const std::string& pattern,
                    const std::vector<const SweepValue*>& values) const {
  const std::vector<std::string>* const list = listOf(pattern, values);
  if (list == nullptr) return words.push_back(filled(pattern, values, 0));
  for (const std::string& word : *list) words.push_back(filled(word, values, 1));
}

/// Returns a pattern with its places filled, also those within what fills them.
/// @throws std::out_of_range for a place that nothing fills, or values that are within each other
std::string SweepFile::filled(const std::string& pattern,
                              const std::vector<const SweepValue*>& values, int depth) const {
  if (depth > kDeepest) throw std::out_of_range(pattern);
  std::string word;
  for (std::size_t at = 0; at < pattern.size();) {
    const std::size_t open = pattern.find('{', at);
    const std::size_t close = open == pattern.npos ? open : pattern.find('}', open);
    word += pattern.substr(at, close == pattern.npos ? pattern.npos : open - at);
    if (close == pattern.npos) break;
    const std::string inner = pattern.substr(open + 1, close - open - 1);
    const std::size_t dot = std::min(inner.find('.'), inner.size());
    const auto key = std::find(keys_.begin(), keys_.end(), inner.substr(0, dot));
    const std::string field = dot < inner.size() ? inner.substr(dot + 1) : "";
    if (key == keys_.end()) throw std::out_of_range(inner);
    const auto& fields = values[static_cast<std::size_t>(key - keys_.begin())]->fields;
    const auto found = fields.find(field);
    if (found == fields.end()) throw std::out_of_range(inner);
    word += filled(found->second, values, depth + 1);
    at = close + 1;
  }
  return word;
}

/// Whether a key stands in the command, or in a value that may stand there.
bool SweepFile::isUsed(const std::string& key) const {
  const auto uses = [&](const std::string& pattern) {
    return pattern.find("{" + key + "}") != pattern.npos ||
           pattern.find("{" + key + ".") != pattern.npos;
  };
  if (std::any_of(patterns_.begin(), patterns_.end(), uses)) return true;
  for (const auto& all : values_) {
    for (const SweepValue& value : all) {
      if (std::any_of(value.words.begin(), value.words.end(), uses)) return true;
      for (const auto& [field, text] : value.fields)
        if (uses(text)) return true;
      for (const auto& [field, words] : value.lists)
        if (std::any_of(words.begin(), words.end(), uses)) return true;
    }
  }
  return false;
}

/// Checks that each value is used, and each place is filled.
void SweepFile::checkUse(const std::string& name) const {
  for (const std::string& key : keys_) {
    if (!isUsed(key))
      throw ConfigError(
          fmt::format("{}: {} is varied, but {{{}}} stands nowhere in command", name, key, key));
  }
  std::size_t most = 0;
  for (const auto& values : values_) most = std::max(most, values.size());
  for (std::size_t i = 0; i < most; ++i) {
    std::vector<const SweepValue*> values;
    for (const auto& all : values_) values.push_back(&all[std::min(i, all.size() - 1)]);
    for (const std::string& pattern : patterns_) {
      try {
        std::vector<std::string> words;
        add(words, pattern, values);
      } catch (const std::out_of_range& error) {
        throw ConfigError(fmt::format("{}: nothing fills {{{}}} of '{}' in command", name,
                                      error.what(), pattern));
      }
    }
  }
}

std::size_t SweepFile::size() const {
  std::size_t tasks = 1;
  for (const auto& values : values_) tasks *= values.size();
  return tasks;
}

SweepTask SweepFile::task(std::size_t index) const {
  std::vector<const SweepValue*> values(keys_.size());
  for (std::size_t k = keys_.size(); k-- > 0; index /= values_[k].size())
    values[k] = &values_[k][index % values_[k].size()];
  SweepTask task;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    task.name += (k == 0 ? "" : ",") + keys_[k] + "=" + values[k]->name;
    task.values.push_back(values[k]->name);
  }
  if (task.name.empty()) task.name = "all";
  ContentDigest digest;
  for (const std::string& pattern : patterns_) add(task.words, pattern, values);
  for (const std::string& word : task.words) digest.add(word);
  task.id = digest.text().substr(0, 16);
  return task;
}

std::vector<std::string> SweepFile::namesOf(const std::string& key) const {
  const auto k = std::find(keys_.begin(), keys_.end(), key) - keys_.begin();
  std::vector<std::string> names;
  for (const SweepValue& value : values_[static_cast<std::size_t>(k)]) names.push_back(value.name);
  return names;
}

}  // namespace ortung::app
