#include "EvalParts.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace ortung::app {
namespace {

/// Items of all runs one after another, and how many of them each run has.
template <class T>
void addColumn(TableWriter& file, const std::string& name,
               const std::vector<std::span<const T>>& all) {
  std::vector<T> items;
  std::vector<std::int32_t> counts;
  for (const std::span<const T> one : all) {
    items.insert(items.end(), one.begin(), one.end());
    counts.push_back(static_cast<std::int32_t>(one.size()));
  }
  file.add(name, {items.size()}, std::span<const T>(items));
  file.add(name + "_counts", {counts.size()}, std::span<const std::int32_t>(counts));
}

/// Reads what addColumn() has written. @throws TableError
template <class T>
std::vector<std::span<const T>> column(const TableFile& file, const std::string& name) {
  std::span<const T> items = file.get<T>(name, {0});
  std::vector<std::span<const T>> all;
  for (const std::int32_t count : file.get<std::int32_t>(name + "_counts", {0})) {
    if (count < 0 || static_cast<std::size_t>(count) > items.size())
      throw TableError(file.path().string() + ": " + name + " has fewer items than it counts");
    all.push_back(items.first(static_cast<std::size_t>(count)));
    items = items.subspan(static_cast<std::size_t>(count));
  }
  return all;
}

EvalPart readPart(const TableFile& file) {
  EvalPart part;
  const auto figures = column<std::uint8_t>(file, "figures");
  const auto errors = column<float>(file, "errors");
  const auto updates = column<float>(file, "update_ms");
  const auto numbers = file.get<std::int32_t>("numbers", {figures.size()});
  if (errors.size() != figures.size() || updates.size() != figures.size())
    throw TableError(file.path().string() + ": its columns have different lengths");
  for (std::size_t i = 0; i < figures.size(); ++i) {
    part.numbers.push_back(static_cast<std::size_t>(numbers[i]));
    part.runs.push_back({{reinterpret_cast<const char*>(figures[i].data()), figures[i].size()},
                         {errors[i].begin(), errors[i].end()},
                         {updates[i].begin(), updates[i].end()}});
  }
  return part;
}

}  // namespace

void write(const EvalPart& part, PartHead head, const std::filesystem::path& file) {
  PartWriter out(file, std::move(head));
  std::vector<std::int32_t> numbers;
  std::vector<std::span<const std::uint8_t>> figures;
  std::vector<std::span<const float>> errors;
  std::vector<std::span<const float>> updates;
  for (const std::size_t number : part.numbers)
    numbers.push_back(static_cast<std::int32_t>(number));
  for (const KeptRun& run : part.runs) {
    figures.emplace_back(reinterpret_cast<const std::uint8_t*>(run.figures.data()),
                         run.figures.size());
    errors.emplace_back(run.errors);
    updates.emplace_back(run.updateMs);
  }
  out.content().add("numbers", {numbers.size()}, std::span<const std::int32_t>(numbers));
  addColumn(out.content(), "figures", figures);
  addColumn(out.content(), "errors", errors);
  addColumn(out.content(), "update_ms", updates);
  out.commit();
}

std::vector<KeptRun> mergeEvaluated(const PartSet& parts) {
  std::vector<std::optional<KeptRun>> all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EvalPart part = readPart(parts.open(i));
    for (std::size_t k = 0; k < part.runs.size(); ++k) {
      const std::size_t number = part.numbers[k];
      if (!Shard{i + 1, parts.size()}.has(number) || number / parts.size() != k)
        throw PartError({fmt::format("part {} has run {}, which belongs to another",
                                     toText({i + 1, parts.size()}), number)});
      if (number >= all.size()) all.resize(number + 1);
      all[number] = std::move(part.runs[k]);
    }
  }
  std::vector<KeptRun> runs;
  for (std::optional<KeptRun>& run : all) {
    if (!run) throw PartError({fmt::format("run {} is in no part", runs.size())});
    runs.push_back(std::move(*run));
  }
  return runs;
}

std::string figuresOf(const std::vector<KeptRun>& runs) {
  const bool isOne = runs.size() == 1 && runs.front().figures.find("\"case\"") == std::string::npos;
  return isOne ? runs.front().figures : toJson(runs);
}

}  // namespace ortung::app
