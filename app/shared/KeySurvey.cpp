#include "KeySurvey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace ortung::app {
namespace {

constexpr int kMostTries = 64;  ///< more required keys than any plugin has
constexpr const char* kNobodysKey = "zzz_nobody_reads_this";

/// Returns the keys that readers of a table know, which are in the error about one that they do
/// not.
std::set<std::string> knownKeys(Parameters table) {
  std::set<std::string> keys;
  table.set(kNobodysKey, true);
  try {
    table.refuseUnread();
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    const std::string sign = "known are ";
    for (std::size_t at = text.find(sign); at < text.size();) {
      at += keys.empty() ? sign.size() : 2;
      const std::size_t end = std::min(text.find(", ", at), text.size());
      keys.insert(text.substr(at, end - at));
      at = end;
    }
  }
  return keys;
}

double plausible(const Question& question) {
  const double low = std::isfinite(question.range.low) ? question.range.low : 0.0;
  const double high = std::isfinite(question.range.high) ? question.range.high : 1e9;
  return std::clamp(1.0, low, high);
}

/// Gives a table some value of the kind that a reader wants.
void fill(Parameters& table, const std::string& key, const Question& question) {
  using Kind = Question::Kind;
  switch (question.kind) {
    case Kind::kFlag:
      return table.set(key, true);
    case Kind::kInteger:
    case Kind::kNumber:
      return table.set(key, plausible(question));
    case Kind::kText:
      return table.set(key, question.choices.empty() ? "x" : question.choices.front());
    case Kind::kNumbers: {
      const std::size_t count = question.count < 0 ? 2 : static_cast<std::size_t>(question.count);
      return table.set(key, std::vector<double>(count, plausible(question)));
    }
    case Kind::kTexts: {
      Parameters::Node text;
      text.value = std::string("x");
      return table.set(key, Parameters::Node{Parameters::List{text}});
    }
    case Kind::kTable:
    case Kind::kTables:
      return;  // nobody misses them
  }
}

std::string number(double value) { return fmt::format("{:.10g}", value); }

std::string numberText(const Question& question, const std::string& what) {
  const Range& range = question.range;
  const bool hasLow = std::isfinite(range.low), hasHigh = std::isfinite(range.high);
  if (hasLow && hasHigh)
    return what + " in [" + number(range.low) + ", " + number(range.high) + "]";
  if (hasLow) return what + " of at least " + number(range.low);
  if (hasHigh) return what + " of at most " + number(range.high);
  return what;
}

/// Joins what was asked for one key by two reads. A bound that was not the same hangs on the values
/// of other keys, so it is none.
void join(std::optional<Question>& there, const std::optional<Question>& other) {
  if (!there) there = other;
  if (!other || other->kind != there->kind) return;
  if (other->range.low != there->range.low) there->range.low = Range().low;
  if (other->range.high != there->range.high) there->range.high = Range().high;
  if (other->count != there->count) there->count = -1;
  if (other->choices != there->choices) there->choices.clear();
}

/// Gives a table another value than the default, if it is one of numbers.
void vary(Parameters& table, const std::string& key, const Question& question) {
  using Kind = Question::Kind;
  if (question.kind == Kind::kNumbers && question.count < 0) {
    table.set(key, std::vector<double>(3, plausible(question)));
    return;
  }
  if (question.kind != Kind::kNumber && question.kind != Kind::kInteger) return;
  const double usual =
      question.fallback ? std::atof(question.fallback->c_str()) : plausible(question);
  double other = std::min(2.0 * usual + 1.0, question.range.high);
  if (other == usual) other = std::max(usual / 2.0, question.range.low);
  if (question.kind == Kind::kInteger) other = std::floor(other);
  table.set(key, other);
}

}  // namespace

KeySurvey surveyOf(const Parameters& table) {
  KeySurvey survey;
  const auto questions = table.questions();
  const std::vector<std::string> present = table.keys();
  // Before those of tables within it, which would be refused first.
  std::set<std::string> known = knownKeys(table);
  for (const auto& [key, question] : questions) known.insert(key);
  known.erase(kNobodysKey);
  for (const std::string& key : known) {
    KeySurvey::Key& entry = survey.keys[key];
    const bool isThere = std::find(present.begin(), present.end(), key) != present.end();
    if (const auto found = questions.find(key); found != questions.end())
      entry.question = found->second;
    entry.isRequired = isThere && entry.question && !entry.question->fallback;
    for (const Parameters& below : table.askedTables(key)) {
      const auto its = below.keys();
      const bool isPlugin = std::find(its.begin(), its.end(), "plugin") != its.end();
      const std::string plugin = isPlugin ? below.text("plugin") : "";
      const KeySurvey one = surveyOf(below);
      survey.tables[key].addTables(one);
      if (isPlugin) survey.tables[key].variants[plugin].addTables(one);
    }
  }
  return survey;
}

void KeySurvey::addTables(const KeySurvey& others) {
  const bool isFirst = keys.empty();
  for (auto& [key, entry] : keys)
    if (!others.keys.contains(key)) entry.isRequired = false;
  for (const auto& [key, entry] : others.keys) {
    const auto [there, isNew] = keys.try_emplace(key, entry);
    join(there->second.question, entry.question);
    there->second.isRequired =
        entry.isRequired && (isFirst || (!isNew && there->second.isRequired));
  }
  for (const auto& [key, survey] : others.tables) tables[key].addTables(survey);
  for (const auto& [name, survey] : others.variants) variants[name].addTables(survey);
}

void KeySurvey::addReader(const KeySurvey& other) {
  for (const auto& [key, entry] : other.keys) {
    Key& there = keys[key];
    join(there.question, entry.question);
    there.isRequired = there.isRequired || entry.isRequired;
  }
  for (const auto& [key, survey] : other.tables) tables[key].addReader(survey);
  for (const auto& [name, survey] : other.variants) variants[name].addReader(survey);
}

namespace {

/// What is given to a reader: keys of its table by name, and of tables within it by both names.
struct Given {
  std::map<std::string, Question> keys;
  std::map<std::string, std::map<std::string, Question>> tables;

  bool contains(const std::string& key) const { return keys.contains(key) || tables.contains(key); }
};

/// Adds to what is given the first key that was needed and is not; returns false if there is none.
bool addMissing(Given& given, const Parameters& table) {
  for (const auto& [key, question] : table.questions()) {
    if (!question.fallback && given.keys.emplace(key, question).second) return true;
    if (question.kind != Question::Kind::kTable) continue;
    for (const Parameters& below : table.askedTables(key))
      for (const auto& [inner, its] : below.questions())
        if (!its.fallback && given.tables[key].emplace(inner, its).second) return true;
  }
  return false;
}

using Reader = std::function<void(const Parameters&)>;

/// Lets a reader read a table of what is given, perhaps with a change. @return the table, and
/// whether the reader had nothing against it
std::pair<Parameters, bool> ask(const Reader& read, const Given& given,
                                const std::function<void(Parameters&)>& change = {}) {
  Parameters table("survey");
  table.survey();
  for (const auto& [key, question] : given.keys) fill(table, key, question);
  for (const auto& [key, questions] : given.tables) {
    Parameters below("survey");
    for (const auto& [inner, question] : questions) fill(below, inner, question);
    Parameters::Node node;
    node.value = below;
    table.set(key, node);
  }
  if (change) change(table);
  try {
    read(table);
    return {table, true};
  } catch (const std::exception&) {
    return {table, false};
  }
}

}  // namespace

KeySurvey surveyKeys(const Reader& read) {
  KeySurvey survey;
  Given given;
  for (int i = 0; i < kMostTries; ++i) {
    const auto [table, isFine] = ask(read, given);
    if (!isFine && addMissing(given, table)) continue;
    survey = surveyOf(table);
    break;
  }
  for (auto& [key, entry] : survey.keys) entry.isRequired = given.contains(key);
  // Whoever only asked whether a key is there reads it if it is.
  for (auto& [key, entry] : survey.keys) {
    if (entry.question) continue;
    Given more = given;
    more.keys.emplace(key, Question{.kind = Question::Kind::kNumber});
    const auto questions = ask(read, more).first.questions();
    if (questions.contains(key)) entry.question = questions.at(key);
  }
  // Bounds that depend on another key differ when that does.
  for (const auto& [varied, entry] : std::map(survey.keys)) {
    if (!entry.question) continue;
    const auto change = [&](Parameters& table) { vary(table, varied, *entry.question); };
    for (const auto& [key, question] : ask(read, given, change).first.questions())
      if (survey.keys.contains(key)) join(survey.keys[key].question, question);
  }
  return survey;
}

std::string exampleOf(const Question& question) {
  using Kind = Question::Kind;
  if (question.fallback) return *question.fallback;
  const std::string text = question.choices.empty() ? "x" : question.choices.front();
  switch (question.kind) {
    case Kind::kFlag:
      return "true";
    case Kind::kInteger:
    case Kind::kNumber:
      return number(plausible(question));
    case Kind::kText:
      return '"' + text + '"';
    case Kind::kNumbers: {
      const std::vector<std::string> all(
          question.count < 0 ? 2U : static_cast<unsigned>(question.count),
          number(plausible(question)));
      return fmt::format("[{}]", fmt::join(all, ", "));
    }
    case Kind::kTexts:
      return "[\"x\"]";
    case Kind::kTable:
      return "{}";
    case Kind::kTables:
      return "[]";
  }
  return "";
}

std::string textOf(const Question& question) {
  using Kind = Question::Kind;
  switch (question.kind) {
    case Kind::kFlag:
      return "true or false";
    case Kind::kInteger:
      return numberText(question, "a whole number");
    case Kind::kNumber:
      return numberText(question, "a number");
    case Kind::kText:
      return question.choices.empty() ? "a text"
                                      : fmt::format("one of {}", fmt::join(question.choices, ", "));
    case Kind::kNumbers:
      return question.count < 0 ? numberText(question, "numbers")
                                : numberText(question, fmt::format("{} numbers", question.count));
    case Kind::kTexts:
      return "texts";
    case Kind::kTable:
      return "a table";
    case Kind::kTables:
      return "tables";
  }
  return "";
}

}  // namespace ortung::app
