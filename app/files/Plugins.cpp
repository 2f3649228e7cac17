#include "Plugins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "Console.hpp"
#include "PluginOffer.hpp"
#include "PluginSentences.hpp"
#include "SurveyedPlugins.hpp"
#include "ortung/base/Nearest.hpp"
#include "ortung/sim_api/Player.hpp"

namespace ortung::app {
namespace {

/// A kind of plugins, as people call it.
struct Kind {
  const char* word;
  std::vector<std::string> interfaces;  ///< interfaces that its plugins have, the first one always
  std::optional<PluginKind> table;      ///< table of a file that holds its settings
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kKinds = {
      {"sensor", {"SensorData", "Sensor", "Extractor"}, PluginKind::kSensor},
      {"motion", {"MotionModel"}, PluginKind::kMotion},
      {"drive", {"Drive"}, PluginKind::kDrive},
      {"source", {"Source"}, {}},
      {"player", {"Player"}, {}},
      {"referee", {"Referee"}, {}},
      {"device", {"DeviceDriver"}, {}}};
  return kKinds;
}

const Kind& kindNamed(const std::string& word) {
  std::vector<std::string> words;
  for (const Kind& kind : kinds()) {
    if (kind.word == word) return kind;
    words.push_back(kind.word);
  }
  throw UsageError("there is no kind of plugins '" + word + "'" + didYouMean(word, words) +
                   "; there are " + kindsText());
}

void print(const Offer& offer) {
  const PluginFactory::Found& found = offer.found;
  if (!found.error.empty()) {
    fmt::print("{}\n  BROKEN: {}\n", printable(found.file.string()), printable(found.error));
    return;
  }
  fmt::print("{}\n  library {}, version {}\n", printable(found.file.string()),
             printable(found.library), printable(found.version));
  for (const auto& entry : found.entries) {
    if (entry.interface == PlayerHelp::kInterface) continue;
    fmt::print("  {:<12} {}\n", printable(kindOf(entry.interface)), printable(entry.name));
    const auto help = offer.help.find(entry.name);
    if (entry.interface != Player::kInterface || help == offer.help.end()) continue;
    for (const std::string& line : help->second) fmt::print("    {}\n", printable(line));
  }
}

std::vector<Offer> lookAtAll(double timeout) {
  std::vector<Offer> offers;
  for (const auto& library : PluginFactory(PluginFactory::standardFolders()).libraries())
    offers.push_back(lookAt(library, timeout));
  return offers;
}

int listLibraries(double timeout) {
  std::size_t broken = 0, count = 0;
  for (const Offer& offer : lookAtAll(timeout)) {
    print(offer);
    ++count;
    if (!offer.found.error.empty()) ++broken;
  }
  fmt::print("{} libraries, {} broken; searched in", count, broken);
  for (const auto& folder : PluginFactory::standardFolders())
    fmt::print(" {}", printable(folder.string()));
  fmt::print("\n  Source       record (built in)\n");
  return broken == 0 ? 0 : 1;
}

/// A row of the table of a kind.
struct Row {
  std::set<std::string> parts;      ///< interfaces of the kind that the plugin has
  std::set<std::string> libraries;  ///< files that have them
  std::vector<std::string> help;    ///< what it is, and its options; may be empty
};

std::map<std::string, Row> rowsOf(const Kind& kind, double timeout) {
  std::map<std::string, Row> rows;
  if (std::string(kind.word) == "source")
    rows["record"] = {{"Source"}, {"built in"}, {"a record, see docs/files.md"}};
  for (const Offer& offer : lookAtAll(timeout)) {
    if (!offer.found.error.empty()) warn(offer.found.file.string() + ": " + offer.found.error);
    for (const auto& entry : offer.found.entries) {
      const std::string part = kindOf(entry.interface);
      const auto& all = kind.interfaces;
      if (std::find(all.begin(), all.end(), part) == all.end()) continue;
      Row& row = rows[entry.name];
      row.parts.insert(part);
      row.libraries.insert(offer.found.file.filename().string());
      if (const auto help = offer.help.find(entry.name); help != offer.help.end())
        row.help = help->second;
    }
  }
  return rows;
}

std::string joined(const std::set<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// What a row says: of a plugin that says nothing of itself and ships with nobody, its parts.
std::string rowText(const Kind& kind, const std::string& name, const Row& row) {
  if (!row.help.empty()) return row.help.front();
  const std::string_view sentence = sentenceOf(kind.word, name);
  return sentence.empty() ? joined(row.parts) : std::string(sentence);
}

int listKind(const Kind& kind, const PluginsArguments& arguments) {
  const auto rows = rowsOf(kind, arguments.timeout);
  if (rows.empty()) {
    fmt::print("there are no plugins of this kind\n");
    return 0;
  }
  std::size_t width = 0;
  for (const auto& [name, row] : rows) width = std::max(width, name.size());
  for (const auto& [name, row] : rows) {
    fmt::print("{:<{}}  {}\n", printable(name), width, printable(rowText(kind, name, row)));
    if (arguments.paths)
      fmt::print("{:<{}}  {}; {}\n", "", width, joined(row.parts),
                 printable(joined(row.libraries)));
  }
  fmt::print("`ortung plugins {} NAME` shows more of one\n", kind.word);
  return 0;
}

void printKeys(const KeySurvey& survey, const std::string& indent) {
  for (const auto& [key, entry] : survey.keys) {
    if (key == "plugin") continue;
    std::string text = entry.question ? textOf(*entry.question) : "";
    if (entry.isRequired) text += "; required";
    if (entry.question && entry.question->fallback && *entry.question->fallback != "{}" &&
        *entry.question->fallback != "[]")
      text += "; default: " + *entry.question->fallback;
    fmt::print("{}{:<{}} {}\n", indent, key, 28 - indent.size(), text);
    if (const auto below = survey.tables.find(key); below != survey.tables.end())
      printKeys(below->second, indent + "  ");
  }
}

int describePlugin(const Kind& kind, const std::string& name, double timeout) {
  if (kind.table) {
    PluginFactory factory(PluginFactory::standardFolders());
    printKeys(surveyPlugin(factory, *kind.table, name), "");
    return 0;
  }
  const auto rows = rowsOf(kind, timeout);
  const auto row = rows.find(name);
  if (row == rows.end()) {
    std::vector<std::string> names;
    for (const auto& [one, its] : rows) names.push_back(one);
    throw UsageError(
        fmt::format("there is no {} '{}'{}", kind.word, name, didYouMean(name, names)));
  }
  fmt::print("{} '{}', in {}\n", kind.word, printable(name), joined(row->second.libraries));
  for (const std::string& line : row->second.help) fmt::print("  {}\n", printable(line));
  return 0;
}

}  // namespace

std::string kindsText() {
  std::string text;
  for (const Kind& kind : kinds()) text += (text.empty() ? "" : ", ") + std::string(kind.word);
  return text;
}

int runPlugins(const PluginsArguments& arguments) {
  if (!arguments.inside.empty()) describeOffer(arguments.inside, arguments.timeout);
  if (arguments.kind.empty()) return listLibraries(arguments.timeout);
  const Kind& kind = kindNamed(arguments.kind);
  if (arguments.name.empty()) return listKind(kind, arguments);
  return describePlugin(kind, arguments.name, arguments.timeout);
}

}  // namespace ortung::app
