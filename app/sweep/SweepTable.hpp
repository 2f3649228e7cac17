#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "SweepStore.hpp"

namespace ortung::app {

/// Figures of a sweep, in a line for each combination of the values that are kept; the figures of
/// all others (seeds, as a rule) are averaged.
struct SweepTable {
  /// Mean of a figure over tasks.
  struct Cell {
    std::size_t count = 0;  ///< tasks that have a number for it
    double mean = 0.0;      ///< NaN without any
    double error = 0.0;     ///< standard error of the mean; NaN for less than two
  };
  struct Row {
    std::vector<std::string> values;  ///< by key
    std::size_t tasks = 0;            ///< number of tasks
    std::size_t done = 0;             ///< how many of them have a result
    std::vector<Cell> cells;          ///< by figure
  };
  std::vector<std::string> keys;     ///< keys that are kept
  std::vector<std::string> figures;  ///< figures as paths, "at_corrections.position_rmse_m"
  std::vector<Row> rows;             ///< in the order of the sweep
  std::vector<std::string> missing;  ///< names of tasks without a result
};

/// Makes the table of what is there; stale results do not count.
/// @param keys keys that are kept, of sweep.keys()
/// @param figures paths of figures; none: those of the usual ones that there are
/// @throws UsageError for a figure that no finished task has, unless none is finished
SweepTable tableOf(SweepStore& store, const SweepFile& sweep, std::vector<std::string> keys,
                   std::vector<std::string> figures);

/// Returns all that the commands of tasks would have written, as JSON: {"format", "tasks":
/// [{"task", "values": {key: name}, "figures"}]}, in the order of the sweep; "figures" is null
/// where there is no result, and "failed" what a task said that failed.
std::string allFigures(SweepStore& store, const SweepFile& sweep);

std::string toMarkdown(const SweepTable& table);
std::string toCsv(const SweepTable& table);
/// Writes a page that needs no other file: the table, and for each figure a curve with error bars
/// over the first key whose values are numbers.
std::string toHtml(const SweepTable& table, const std::string& title);

}  // namespace ortung::app
