#include "Sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "Console.hpp"
#include "Outputs.hpp"
#include "Progress.hpp"
#include "SweepCosts.hpp"
#include "SweepFile.hpp"
#include "SweepRunner.hpp"
#include "SweepStore.hpp"
#include "SweepTable.hpp"

namespace ortung::app {
namespace {

using State = SweepStore::State;

constexpr std::size_t kMostNamed = 20;

std::vector<SweepTask> ownTasks(const SweepFile& sweep, const SweepRunArguments& arguments) {
  const Shard shard = readShard(arguments.shard);
  std::vector<SweepTask> tasks;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    if (arguments.task.empty() && !shard.has(i)) continue;
    SweepTask task = sweep.task(i);
    if (arguments.task.empty() || task.name == arguments.task || task.id == arguments.task)
      tasks.push_back(std::move(task));
  }
  if (tasks.empty() && !arguments.task.empty())
    throw UsageError("--task is '" + arguments.task + "', which is no task of " +
                     arguments.file.string() + "; `ortung sweep plan` lists them");
  return tasks;
}

const char* nameOf(State state) {
  static constexpr std::array<const char*, 5> kNames = {"missing", "done", "stale", "torn",
                                                        "failed"};
  return kNames[static_cast<std::size_t>(state)];
}

/// Tells of tasks whose result is wanted, one line each.
void tellFailures(const SweepStore& store, const SweepFile& sweep,
                  const std::vector<std::string>& failed) {
  for (std::size_t i = 0; i < std::min(failed.size(), kMostNamed); ++i) {
    for (std::size_t k = 0; k < sweep.size(); ++k) {
      const SweepTask task = sweep.task(k);
      if (task.name != failed[i]) continue;
      fail(printable(task.name) + ": failed, see " + store.failureOf(task.id).string());
      break;
    }
  }
  if (failed.size() > kMostNamed)
    fail(fmt::format("and {} more failed", failed.size() - kMostNamed));
}

}  // namespace

int runSweepPlan(const SweepPlanArguments& arguments) {
  const SweepFile sweep(arguments.file);
  std::optional<SweepStore> store;
  if (!arguments.dir.empty()) {
    store.emplace(arguments.dir, sweep);
    store->look();
  }
  SweepCosts costs(sweep.keys());
  for (std::size_t i = 0; store && i < sweep.size(); ++i) {
    const SweepTask task = sweep.task(i);
    if (const auto cost = store->costOf(task.id)) costs.add(task, *cost);
  }
  SweepCost all;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const SweepTask task = sweep.task(i);
    const auto known = store ? store->costOf(task.id) : std::nullopt;
    const auto cost = known ? known : costs.estimate(task);
    fmt::print("{} {}{}\n", task.id, printable(task.name),
               cost ? fmt::format("  {}{:.1f} s, {:.0f} MB", known ? "" : "about ", cost->seconds,
                                  cost->megabytes)
                    : "");
    if (!cost) continue;
    all.seconds += cost->seconds;
    all.megabytes = std::max(all.megabytes, cost->megabytes);
  }
  fmt::print("{} tasks", sweep.size());
  if (costs.known() > 0)
    fmt::print(
        ", about {:.0f} s of a core and at most {:.0f} MB at a time, by the {} that were run",
        all.seconds, all.megabytes, costs.known());
  fmt::print("\n");
  if (costs.known() == 0)
    note(
        "what tasks cost is known once some were run: `ortung sweep run FILE --dir D --task "
        "NAME`, then `ortung sweep plan FILE --dir D`");
  return 0;
}

int runSweepRun(const SweepRunArguments& arguments) {
  const SweepFile sweep(arguments.file);
  const std::vector<SweepTask> tasks = ownTasks(sweep, arguments);
  SweepStore store(arguments.dir, sweep);
  store.look();
  std::vector<SweepTask> open;
  for (const SweepTask& task : tasks)
    if (store.resultOf(task).state != State::kDone) open.push_back(task);
  SweepRunner runner(store, sweep, arguments.jobs);
  std::vector<std::string> failed;
  {
    Progress progress("running tasks", arguments.progress);
    failed = runner.run(open, [&](std::size_t done) {
      progress.update(static_cast<double>(done) / static_cast<double>(open.size()));
    });
  }
  fmt::print("{} of {} tasks were run, {} failed\n", open.size(), tasks.size(), failed.size());
  tellFailures(store, sweep, failed);
  const bool isWhole = failed.empty() && arguments.task.empty() && !tasks.empty();
  if (!isWhole) {
    store.keep(runner.costs());
    return failed.empty() ? 0 : 1;
  }
  store.look();
  store.pack(readShard(arguments.shard), tasks, runner.costs());
  return 0;
}

int runSweepStatus(const SweepStatusArguments& arguments) {
  const SweepFile sweep = SweepStore::sweepOf(arguments.dir);
  SweepStore store(arguments.dir, sweep);
  store.look();
  std::array<std::size_t, 5> counts{};
  std::size_t named = 0;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const SweepTask task = sweep.task(i);
    const SweepStore::Result result = store.resultOf(task);
    ++counts[static_cast<std::size_t>(result.state)];
    if (result.state == State::kDone || (!arguments.all && ++named > kMostNamed)) continue;
    fmt::print("{} {} {}{}\n", nameOf(result.state), task.id, printable(task.name),
               result.why.empty() ? "" : ": " + printable(result.why));
  }
  const std::size_t done = counts[static_cast<std::size_t>(State::kDone)];
  fmt::print("{} of {} tasks are done", done, sweep.size());
  for (const State state : {State::kMissing, State::kStale, State::kTorn, State::kFailed})
    if (const std::size_t count = counts[static_cast<std::size_t>(state)]; count > 0)
      fmt::print(", {} {}", count, nameOf(state));
  fmt::print("\n");
  return done == sweep.size() ? 0 : 1;
}

int runSweepTable(const SweepTableArguments& arguments) {
  const SweepFile sweep = SweepStore::sweepOf(arguments.dir);
  std::vector<std::string> keys = arguments.by;
  for (const std::string& key : keys)
    if (std::find(sweep.keys().begin(), sweep.keys().end(), key) == sweep.keys().end())
      throw UsageError("--by is '" + key + "', which the sweep does not vary");
  if (keys.empty())
    for (const std::string& key : sweep.keys())
      if (key != "seed") keys.push_back(key);
  Outputs outputs(arguments.force);
  outputs.writes("--csv", arguments.csv, OutputKind::kSweepCsv);
  outputs.writes("--json", arguments.json, OutputKind::kSweepJson);
  outputs.writes("--html", arguments.html, OutputKind::kSweepPage);
  SweepStore store(arguments.dir, sweep);
  store.look();
  const SweepTable table = tableOf(store, sweep, keys, arguments.figures);
  outputs.write(arguments.csv, toCsv(table));
  if (!arguments.json.empty()) outputs.write(arguments.json, allFigures(store, sweep));
  outputs.write(arguments.html, toHtml(table, arguments.dir.filename().string()));
  fmt::print("{}", toMarkdown(table));
  if (!table.missing.empty())
    warn(fmt::format("{} of {} tasks have no result, e.g. {}", table.missing.size(), sweep.size(),
                     printable(table.missing.front())));
  return 0;
}

}  // namespace ortung::app
