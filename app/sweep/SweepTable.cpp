#include "SweepTable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "Console.hpp"
#include "SweepFigures.hpp"
#include "SweepMean.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Adding {
  SweepTable::Row row;
  std::vector<SweepMean> sums;
};

std::string shown(const SweepTable::Cell& cell) {
  if (!std::isfinite(cell.mean)) return "-";
  if (!std::isfinite(cell.error)) return fmt::format("{:.4g}", cell.mean);
  return fmt::format("{:.4g} ± {:.2g}", cell.mean, cell.error);
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == text.npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string inMarkdown(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : std::string(1, c == '\n' ? ' ' : c);
  return out.empty() ? "-" : out;
}

/// Figures of finished tasks as they are come across.
class Present {
 public:
  explicit Present(std::vector<std::string> figures)
      : figures_(std::move(figures)), areThere_(figures_.size(), false) {}
  /// Returns the figures of a task, NaN for those that are not known or not there.
  std::vector<double> of(const Json& json) {
    std::vector<double> values;
    for (std::size_t f = 0; f < figures_.size(); ++f) {
      const std::optional<double> value = figureAt(json, figures_[f]);
      areThere_[f] = areThere_[f] || value.has_value();
      values.push_back(value.value_or(kNan));
    }
    // All tasks of a sweep have nearly the same ones.
    if (tasks_++ < kTasksAsked) {
      for (const std::string& path : figuresIn(json, kMostPaths))
        if (known_.insert(path).second) paths_.push_back(path);
    }
    return values;
  }
  const std::vector<bool>& areThere() const { return areThere_; }
  /// @throws UsageError for a figure that none of the tasks has
  void check() const {
    for (std::size_t f = 0; f < figures_.size() && tasks_ > 0; ++f)
      if (!areThere_[f]) throw UsageError("--figures: " + noFigure(figures_[f], paths_));
  }

 private:
  static constexpr std::size_t kTasksAsked = 20;
  static constexpr std::size_t kMostPaths = 1000;
  std::vector<std::string> figures_;
  std::vector<bool> areThere_;
  std::vector<std::string> paths_;
  std::set<std::string> known_;
  std::size_t tasks_ = 0;
};

/// Returns the figures that a command's tables have unless others are wanted: of one run each, or
/// of many runs and cases.
std::vector<std::string> usualFigures(const std::string& command) {
  if (command == "eval")
    return {"converged_after_s",
            "position_median_m",
            "position_rmse_m",
            "heading_rmse_deg",
            "lost_share",
            "tracking_share",
            "nees_mean",
            "summary.0.right.share",
            "summary.0.converged.share",
            "summary.0.after_s.p50",
            "summary.0.position_m.p50",
            "summary.0.lost_share"};
  return {"cells.0.scoring.value"};
}

/// Leaves out the figures that no task has; if no task is done, all stay.
void keepOnly(SweepTable& table, const std::vector<bool>& areThere) {
  if (std::find(areThere.begin(), areThere.end(), true) == areThere.end()) return;
  for (std::size_t f = areThere.size(); f-- > 0;) {
    if (areThere[f]) continue;
    const auto at = static_cast<std::ptrdiff_t>(f);
    table.figures.erase(table.figures.begin() + at);
    for (SweepTable::Row& row : table.rows) row.cells.erase(row.cells.begin() + at);
  }
}

std::string csvNumber(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace

SweepTable tableOf(SweepStore& store, const SweepFile& sweep, std::vector<std::string> keys,
                   std::vector<std::string> figures) {
  const bool areUsual = figures.empty();
  SweepTable table{
      std::move(keys), areUsual ? usualFigures(sweep.command()) : std::move(figures), {}, {}};
  Present present(table.figures);
  std::vector<std::size_t> kept;
  for (const std::string& key : table.keys)
    kept.push_back(static_cast<std::size_t>(
        std::find(sweep.keys().begin(), sweep.keys().end(), key) - sweep.keys().begin()));
  std::map<std::vector<std::string>, std::size_t> numbers;
  std::vector<Adding> rows;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const SweepTask task = sweep.task(i);
    std::vector<std::string> values;
    for (const std::size_t k : kept) values.push_back(task.values[k]);
    const auto [place, isNew] = numbers.try_emplace(values, rows.size());
    if (isNew) rows.push_back({{values, 0, 0, {}}, std::vector<SweepMean>(table.figures.size())});
    Adding& row = rows[place->second];
    ++row.row.tasks;
    if (store.resultOf(task).state != SweepStore::State::kDone) {
      table.missing.push_back(task.name);
      continue;
    }
    ++row.row.done;
    const Json json = Json::parse(store.figuresOf(task));
    const std::vector<double> found = present.of(json);
    for (std::size_t f = 0; f < found.size(); ++f) row.sums[f].add(found[f]);
  }
  if (!areUsual) present.check();
  for (Adding& row : rows) {
    for (const SweepMean& sum : row.sums) row.row.cells.push_back(sum.cell());
    table.rows.push_back(std::move(row.row));
  }
  if (areUsual) keepOnly(table, present.areThere());
  return table;
}

std::string allFigures(SweepStore& store, const SweepFile& sweep) {
  std::string text = "{\n\"format\": \"ortung sweep figures 1\",\n\"tasks\": [";
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const SweepTask task = sweep.task(i);
    Json values = Json::object();
    for (std::size_t k = 0; k < sweep.keys().size(); ++k) values[sweep.keys()[k]] = task.values[k];
    const SweepStore::State state = store.resultOf(task).state;
    const bool isDone = state == SweepStore::State::kDone;
    const bool hasFailed = state == SweepStore::State::kFailed;
    const auto dumped = [](const Json& json) {
      return json.dump(-1, ' ', true, Json::error_handler_t::replace);
    };
    text += fmt::format("{}\n{{\"task\": {}, \"values\": {}, \"figures\": {}{}}}", i > 0 ? "," : "",
                        dumped(task.name), dumped(values),
                        isDone ? dumped(Json::parse(store.figuresOf(task))) : "null",
                        hasFailed ? ", \"failed\": " + dumped(store.saidBy(task)) : "");
  }
  return text + "\n]\n}\n";
}

std::string toMarkdown(const SweepTable& table) {
  std::string text = "|";
  for (const std::string& key : table.keys) text += " " + inMarkdown(key) + " |";
  text += " done |";
  for (const std::string& figure : table.figures) text += " " + inMarkdown(figure) + " |";
  text += "\n|";
  for (std::size_t i = 0; i < table.keys.size() + table.figures.size() + 1; ++i) text += "---|";
  text += "\n";
  for (const SweepTable::Row& row : table.rows) {
    text += "|";
    for (const std::string& value : row.values) text += " " + inMarkdown(value) + " |";
    text += fmt::format(" {} of {} |", row.done, row.tasks);
    for (const SweepTable::Cell& cell : row.cells) text += " " + shown(cell) + " |";
    text += "\n";
  }
  return text;
}

std::string toCsv(const SweepTable& table) {
  std::string text;
  for (const std::string& key : table.keys) text += quoted(key) + ",";
  text += "tasks,done";
  for (const std::string& figure : table.figures)
    text += "," + quoted(figure) + "," + quoted(figure + " error");
  text += "\n";
  for (const SweepTable::Row& row : table.rows) {
    for (const std::string& value : row.values) text += quoted(value) + ",";
    text += fmt::format("{},{}", row.tasks, row.done);
    for (const SweepTable::Cell& cell : row.cells)
      text += "," + csvNumber(cell.mean) + "," + csvNumber(cell.error);
    text += "\n";
  }
  return text;
}

}  // namespace ortung::app
