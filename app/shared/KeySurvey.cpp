#include "KeySurvey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
    if (!there->second.question) there->second.question = entry.question;
    there->second.isRequired =
        entry.isRequired && (isFirst || (!isNew && there->second.isRequired));
  }
  for (const auto& [key, survey] : others.tables) tables[key].addTables(survey);
  for (const auto& [name, survey] : others.variants) variants[name].addTables(survey);
}

void KeySurvey::addReader(const KeySurvey& other) {
  for (const auto& [key, entry] : other.keys) {
    Key& there = keys[key];
    if (!there.question) there.question = entry.question;
    there.isRequired = there.isRequired || entry.isRequired;
  }
  for (const auto& [key, survey] : other.tables) tables[key].addReader(survey);
  for (const auto& [name, survey] : other.variants) variants[name].addReader(survey);
}

KeySurvey surveyKeys(const std::function<void(const Parameters&)>& read) {
  KeySurvey survey;
  std::map<std::string, Question> given;
  const auto ask = [&](const std::map<std::string, Question>& values) {
    Parameters table("survey");
    table.survey();
    for (const auto& [key, question] : values) fill(table, key, question);
    bool isFine = true;
    try {
      read(table);
    } catch (const std::exception&) {
      isFine = false;
    }
    return std::pair(table, isFine);
  };
  for (int i = 0; i < kMostTries; ++i) {
    const auto [table, isFine] = ask(given);
    const auto questions = table.questions();
    const auto missing = std::find_if(questions.begin(), questions.end(), [&](const auto& one) {
      return !one.second.fallback && !given.contains(one.first);
    });
    const bool isLast = isFine || missing == questions.end();
    if (isLast) {
      survey = surveyOf(table);
      break;
    }
    given.insert(*missing);
  }
  for (auto& [key, entry] : survey.keys) entry.isRequired = given.contains(key);
  // Whoever only asked whether a key is there reads it if it is.
  for (auto& [key, entry] : survey.keys) {
    if (entry.question) continue;
    auto values = given;
    values.emplace(key, Question{.kind = Question::Kind::kNumber});
    const auto questions = ask(values).first.questions();
    if (questions.contains(key)) entry.question = questions.at(key);
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
