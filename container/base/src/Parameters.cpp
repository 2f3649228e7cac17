#include "ortung/base/Parameters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "ortung/base/Nearest.hpp"

namespace ortung {

struct Parameters::Table {
  std::string where;
  std::map<std::string, Node> values;
  std::set<std::string> read;   ///< keys whose values were read
  std::set<std::string> asked;  ///< keys that a reader knows
  bool isSurveyed = false;
  std::map<std::string, Question> questions;  ///< kept only in a survey: large files have many
  std::map<std::string, std::vector<Parameters>> askedTables;
  int line = 0;  ///< line at which the table begins; 0: not known
};

namespace {

std::string toText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string toText(const Range& range) {
  if (std::isinf(range.low)) return "at most " + toText(range.high);
  if (std::isinf(range.high)) return "at least " + toText(range.low);
  return "in [" + toText(range.low) + ", " + toText(range.high) + "]";
}

/// Returns "a number", with its bounds if there are any.
std::string numberWithin(const Range& range) {
  const bool bounded = std::isfinite(range.low) || std::isfinite(range.high);
  return bounded ? "a number " + toText(range) : "a number";
}

std::string quoted(const std::string& text) { return '"' + text + '"'; }

template <class Items, class ToText>
std::string listOf(const Items& items, ToText toText) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + toText(item);
  return "[" + text + "]";
}

const char* kindOf(const Parameters::Node& node) {
  static constexpr const char* kKinds[] = {
      "a flag (true/false)", "a whole number", "a number", "a text", "a list", "a table"};
  return kKinds[node.value.index()];
}

}  // namespace

ConfigError::~ConfigError() = default;

Parameters::Parameters(std::string where) : table_(std::make_shared<Table>()) {
  table_->where = std::move(where);
}

void Parameters::set(const std::string& key, bool value) { set(key, Node{value, 0}); }
void Parameters::set(const std::string& key, double value) { set(key, Node{value, 0}); }
void Parameters::set(const std::string& key, const char* value) { set(key, std::string(value)); }
void Parameters::set(const std::string& key, const std::string& value) { set(key, Node{value, 0}); }
void Parameters::set(const std::string& key, const std::vector<double>& values) {
  List list(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) list[i].value = values[i];
  Node node;
  node.value = std::move(list);
  set(key, std::move(node));
}
void Parameters::set(const std::string& key, Node value) {
  table_->values.insert_or_assign(key, std::move(value));
}

bool Parameters::has(const std::string& key) const {
  table_->asked.insert(key);
  return table_->values.contains(key);
}

std::vector<std::string> Parameters::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, node] : table_->values) keys.push_back(key);
  return keys;
}

const std::string& Parameters::where() const { return table_->where; }

const Parameters::Node* Parameters::look(const std::string& key) const {
  const auto it = table_->values.find(key);
  table_->asked.insert(key);
  if (it == table_->values.end()) return nullptr;
  table_->read.insert(key);
  return &it->second;
}

void Parameters::survey() { table_->isSurveyed = true; }

/// Callers make texts for a question only if it is surveyed, as most tables are not.
void Parameters::note(const std::string& key, Question question) const {
  if (!table_->isSurveyed) return;
  const auto [there, isNew] = table_->questions.try_emplace(key, question);
  if (isNew) return;
  // The same value may be asked for in several ways, e.g. as one of some words after as a text.
  if (question.kind != there->second.kind) return;
  if (!question.fallback) question.fallback = there->second.fallback;
  if (question.choices.empty()) question.choices = there->second.choices;
  there->second = std::move(question);
}

void Parameters::keepAsked(const std::string& key, const std::vector<Parameters>& tables) const {
  if (!table_->isSurveyed) return;
  std::vector<Parameters>& all = table_->askedTables[key];
  for (const Parameters& table : tables) {
    const auto isIt = [&](const Parameters& one) { return one.table_ == table.table_; };
    if (std::any_of(all.begin(), all.end(), isIt)) continue;
    table.table_->isSurveyed = true;
    all.push_back(table);
  }
}

std::map<std::string, Question> Parameters::questions() const { return table_->questions; }

std::vector<Parameters> Parameters::askedTables(const std::string& key) const {
  const auto found = table_->askedTables.find(key);
  return found == table_->askedTables.end() ? std::vector<Parameters>() : found->second;
}

void Parameters::fail(const std::string& key, const std::string& message) const {
  const auto it = table_->values.find(key);
  std::string place = table_->where;
  const int line = it != table_->values.end() ? it->second.line : table_->line;
  if (line > 0) place += (place.empty() ? "line " : ":") + std::to_string(line);
  throw ConfigError((place.empty() ? "" : place + ": ") + key + " " + message);
}

const Parameters::Node& Parameters::need(const std::string& key) const {
  const Node* node = look(key);
  if (node != nullptr) return *node;
  constexpr std::size_t kMostNamed = 8;
  std::string there;
  std::string meant;
  std::size_t named = 0;
  const std::vector<std::string> wanted = {key};
  for (const auto& [name, value] : table_->values)
    if (meant.empty() && !table_->asked.contains(name) && !nearest(name, wanted).empty())
      meant = name;
  for (const auto& [name, value] : table_->values) {
    if (named++ == kMostNamed) break;
    there += (there.empty() ? "" : ", ") + name;
  }
  if (table_->values.size() > kMostNamed) there += ", ...";
  fail(key, "is missing" + (meant.empty() ? "" : " (is '" + meant + "' meant for it?)") +
                (there.empty() ? "" : "; there are " + there));
}

double Parameters::toNumber(const std::string& key, const Node& node, const Range& range) const {
  double value = 0.0;
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) {
    value = static_cast<double>(*whole);
  } else if (const auto* real = std::get_if<double>(&node.value)) {
    value = *real;
  } else {
    fail(key, std::string("is ") + kindOf(node) + ", expected " + numberWithin(range));
  }
  if (!std::isfinite(value)) fail(key, "is not finite, expected " + numberWithin(range));
  if (value < range.low || value > range.high) {
    fail(key, "is " + toText(value) + ", must be " + toText(range));
  }
  return value;
}

double Parameters::number(const std::string& key, const Range& range) const {
  note(key, {.kind = Question::Kind::kNumber, .range = range});
  return toNumber(key, need(key), range);
}

double Parameters::numberOr(const std::string& key, double fallback, const Range& range) const {
  if (table_->isSurveyed)
    note(key, {.kind = Question::Kind::kNumber, .range = range, .fallback = toText(fallback)});
  const Node* node = look(key);
  return node == nullptr ? fallback : toNumber(key, *node, range);
}

std::int64_t Parameters::integer(const std::string& key, const Range& range) const {
  note(key, {.kind = Question::Kind::kInteger, .range = range});
  const double value = toNumber(key, need(key), range);
  if (value != std::floor(value) || std::abs(value) > 0x1p53) {
    fail(key, "is " + toText(value) + ", expected a whole number");
  }
  return static_cast<std::int64_t>(value);
}

std::int64_t Parameters::integerOr(const std::string& key, std::int64_t fallback,
                                   const Range& range) const {
  if (table_->isSurveyed)
    note(key,
         {.kind = Question::Kind::kInteger, .range = range, .fallback = std::to_string(fallback)});
  return look(key) == nullptr ? fallback : integer(key, range);
}

std::string Parameters::text(const std::string& key) const {
  note(key, {.kind = Question::Kind::kText});
  const Node& node = need(key);
  const auto* text = std::get_if<std::string>(&node.value);
  if (text == nullptr) fail(key, std::string("is ") + kindOf(node) + ", expected a text");
  return *text;
}

std::string Parameters::textOr(const std::string& key, const std::string& fallback) const {
  if (table_->isSurveyed) note(key, {.kind = Question::Kind::kText, .fallback = quoted(fallback)});
  return look(key) == nullptr ? fallback : text(key);
}

std::string Parameters::choiceOr(const std::string& key, const std::string& fallback,
                                 const std::vector<std::string>& choices) const {
  if (table_->isSurveyed)
    note(key, {.kind = Question::Kind::kText, .choices = choices, .fallback = quoted(fallback)});
  const std::string value = textOr(key, fallback);
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    std::string list;
    for (const std::string& choice : choices) list += (list.empty() ? "" : ", ") + choice;
    fail(key, "is '" + value + "', must be one of: " + list + didYouMean(value, choices));
  }
  return value;
}

bool Parameters::flagOr(const std::string& key, bool fallback) const {
  note(key, {.kind = Question::Kind::kFlag, .fallback = fallback ? "true" : "false"});
  const Node* node = look(key);
  if (node == nullptr) return fallback;
  const auto* flag = std::get_if<bool>(&node->value);
  if (flag == nullptr) fail(key, std::string("is ") + kindOf(*node) + ", expected true or false");
  return *flag;
}

std::vector<double> Parameters::numbers(const std::string& key, int count,
                                        const Range& range) const {
  note(key, {.kind = Question::Kind::kNumbers, .range = range, .count = count});
  const Node& node = need(key);
  const auto* list = std::get_if<List>(&node.value);
  if (list == nullptr)
    fail(key, std::string("is ") + kindOf(node) + ", expected a list of numbers");
  if (count >= 0 && list->size() != static_cast<std::size_t>(count)) {
    fail(key,
         "has " + std::to_string(list->size()) + " entries, expected " + std::to_string(count));
  }
  std::vector<double> values;
  values.reserve(list->size());
  for (const Node& entry : *list) values.push_back(toNumber(key, entry, range));
  return values;
}

std::vector<double> Parameters::numbersOr(const std::string& key,
                                          const std::vector<double>& fallback, int count,
                                          const Range& range) const {
  if (table_->isSurveyed)
    note(key, {.kind = Question::Kind::kNumbers,
               .range = range,
               .count = count,
               .fallback = listOf(fallback, [](double value) { return toText(value); })});
  return look(key) == nullptr ? fallback : numbers(key, count, range);
}

std::vector<std::string> Parameters::texts(const std::string& key) const {
  note(key, {.kind = Question::Kind::kTexts});
  const Node& node = need(key);
  const auto* list = std::get_if<List>(&node.value);
  if (list == nullptr) fail(key, std::string("is ") + kindOf(node) + ", expected a list of texts");
  std::vector<std::string> values;
  for (const Node& entry : *list) {
    const auto* text = std::get_if<std::string>(&entry.value);
    if (text == nullptr) fail(key, std::string("holds ") + kindOf(entry) + ", expected texts only");
    values.push_back(*text);
  }
  return values;
}

Parameters Parameters::table(const std::string& key) const {
  note(key, {.kind = Question::Kind::kTable, .fallback = "{}"});
  const Node* node = look(key);
  if (node == nullptr) {
    const Parameters missing(table_->where);
    missing.table_->line = table_->line;  // errors name where it would be
    keepAsked(key, {missing});
    return missing;
  }
  const auto* table = std::get_if<Parameters>(&node->value);
  if (table == nullptr)
    fail(key, std::string("is ") + kindOf(*node) + ", expected a table [" + key + "]");
  table->table_->line = node->line;
  keepAsked(key, {*table});
  return *table;
}

Parameters Parameters::takeTable(const std::string& key) const {
  Parameters taken = table(key);
  const auto found = table_->values.find(key);
  if (found != table_->values.end()) found->second.value = Parameters(table_->where);
  return taken;
}

std::vector<Parameters> Parameters::tables(const std::string& key) const {
  note(key, {.kind = Question::Kind::kTables, .fallback = "[]"});
  const Node* node = look(key);
  if (node == nullptr) return {};
  const auto* list = std::get_if<List>(&node->value);
  if (list == nullptr)
    fail(key, std::string("is ") + kindOf(*node) + ", expected tables [[" + key + "]]");
  std::vector<Parameters> tables;
  for (const Node& entry : *list) {
    const auto* table = std::get_if<Parameters>(&entry.value);
    if (table == nullptr)
      fail(key, std::string("holds ") + kindOf(entry) + ", expected tables only");
    table->table_->line = entry.line;
    tables.push_back(*table);
  }
  keepAsked(key, tables);
  return tables;
}

void Parameters::refuseUnread() const {
  for (const auto& [key, node] : table_->values) {
    if (!table_->read.contains(key)) {
      const std::vector<std::string> names(table_->asked.begin(), table_->asked.end());
      std::string known;
      for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
      fail(key, "is not known here" + didYouMean(key, names) +
                    (known.empty() ? "" : "; known are " + known));
    }
    if (const auto* table = std::get_if<Parameters>(&node.value)) table->refuseUnread();
    if (const auto* list = std::get_if<List>(&node.value)) {
      for (const Node& entry : *list) {
        if (const auto* table = std::get_if<Parameters>(&entry.value)) table->refuseUnread();
      }
    }
  }
}

}  // namespace ortung
