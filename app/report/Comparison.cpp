#include "Comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "Console.hpp"
#include "RunJson.hpp"
#include "Statistics.hpp"
#include "ortung/base/Statistics.hpp"

namespace ortung::app {
namespace {

using Pair = std::pair<const FiledRun*, const FiledRun*>;

constexpr std::size_t kMostShown = 20;  ///< greatest number of runs in a list

double figure(const FiledRun& run, const std::string& key) {
  const auto found = run.figures.find(key);
  return found == run.figures.end() ? std::nan("") : found->second;
}

bool hasConverged(const FiledRun& run) { return std::isfinite(figure(run, "converged_after_s")); }

bool wasNeverLost(const FiledRun& run) {
  return hasConverged(run) && figure(run, "lost_share") == 0.0;
}

std::vector<Pair> pairsOf(const std::vector<FiledRun>& before, const std::vector<FiledRun>& after,
                          Comparison& comparison) {
  std::map<std::string, std::vector<const FiledRun*>> counterparts;
  for (auto run = after.rbegin(); run != after.rend(); ++run)
    counterparts[run->name()].push_back(&*run);
  std::vector<Pair> pairs;
  for (const FiledRun& run : before) {
    auto found = counterparts.find(run.name());
    if (found == counterparts.end() || found->second.empty()) {
      comparison.onlyBefore.push_back(run.name());
      continue;
    }
    pairs.emplace_back(&run, found->second.back());
    found->second.pop_back();
  }
  for (const auto& [name, runs] : counterparts)
    comparison.onlyAfter.insert(comparison.onlyAfter.end(), runs.size(), name);
  comparison.pairs = pairs.size();
  return pairs;
}

/// Counts successes in pairs of runs.
class Successes {
 public:
  explicit Successes(std::string name) { result_.name = std::move(name); }
  void add(bool before, bool after) {
    ++result_.pairs;
    result_.before += before ? 1 : 0;
    result_.after += after ? 1 : 0;
    result_.better += after && !before ? 1 : 0;
    result_.worse += before && !after ? 1 : 0;
  }
  void addTo(std::vector<ComparedSuccess>& all) {
    if (result_.pairs == 0) return;
    result_.p = mcNemarExact(result_.better, result_.worse);
    all.push_back(result_);
  }

 private:
  ComparedSuccess result_;
};

/// Collects a figure of pairs of runs.
class Figures {
 public:
  explicit Figures(std::string name) { result_.name = std::move(name); }
  void add(double before, double after) {
    if (!std::isfinite(before) || !std::isfinite(after)) return;
    before_.push_back(before);
    after_.push_back(after);
    differences_.push_back(after - before);
    result_.better += after < before ? 1 : 0;
    result_.worse += after > before ? 1 : 0;
  }
  void addTo(std::vector<ComparedFigure>& all) {
    if (before_.empty()) return;
    result_.pairs = before_.size();
    result_.medianBefore = quantile(before_, 0.5);
    result_.medianAfter = quantile(after_, 0.5);
    result_.p = wilcoxonSignedRank(differences_);
    all.push_back(result_);
  }

 private:
  ComparedFigure result_;
  std::vector<double> before_;
  std::vector<double> after_;
  std::vector<double> differences_;
};

void compareSuccesses(const std::vector<Pair>& pairs, std::vector<ComparedSuccess>& all) {
  Successes converged("converged");
  Successes neverLost("converged, never lost");
  std::map<std::string, Successes> right;  // by kind of case
  for (const auto& [a, b] : pairs) {
    if (a->kind == "whole") {
      converged.add(hasConverged(*a), hasConverged(*b));
      neverLost.add(wasNeverLost(*a), wasNeverLost(*b));
    }
    for (std::size_t i = 0; i < std::min(a->events.size(), b->events.size()); ++i)
      right.try_emplace(a->kind, "right, " + a->kind)
          .first->second.add(a->events[i].isRight, b->events[i].isRight);
  }
  converged.addTo(all);
  neverLost.addTo(all);
  for (auto& [kind, successes] : right) successes.addTo(all);
}

void compareFigures(const std::vector<Pair>& pairs, std::vector<ComparedFigure>& all) {
  for (const char* key : {"position_median_m", "position_p95_m", "position_p99_m", "position_max_m",
                          "position_rmse_m", "heading_rmse_deg", "lost_share",
                          "wrong_while_tracking_share", "converged_after_s"}) {
    Figures figures(key);
    for (const auto& [a, b] : pairs) figures.add(figure(*a, key), figure(*b, key));
    figures.addTo(all);
  }
  Figures nees("nees_mean, |ln| off 3");
  const auto offThree = [](const FiledRun& run) {
    return std::abs(std::log(figure(run, "nees_mean") / 3.0));
  };
  for (const auto& [a, b] : pairs) nees.add(offThree(*a), offThree(*b));
  nees.addTo(all);
  Figures after("case: after_s");
  Figures readings("case: after_readings");
  for (const auto& [a, b] : pairs) {
    for (std::size_t i = 0; i < std::min(a->events.size(), b->events.size()); ++i) {
      after.add(a->events[i].after, b->events[i].after);
      readings.add(a->events[i].readings, b->events[i].readings);
    }
  }
  after.addTo(all);
  readings.addTo(all);
  for (const char* key : {"update_ms_p50", "update_ms_p99", "update_ms_max"}) {
    Figures figures(key);
    for (const auto& [a, b] : pairs) figures.add(figure(*a, key), figure(*b, key));
    figures.addTo(all);
  }
}

/// Returns the most important large difference of a pair, if there is one.
std::optional<ChangedRun> changeOf(const FiledRun& a, const FiledRun& b) {
  const auto changed = [&](bool isBetter, const std::string& why) {
    return ChangedRun{a.name(), isBetter, why};
  };
  for (std::size_t i = 0; i < std::min(a.events.size(), b.events.size()); ++i) {
    if (a.events[i].isRight == b.events[i].isRight) continue;
    return changed(b.events[i].isRight,
                   b.events[i].isRight ? "localizes now" : "no longer localizes");
  }
  if (!a.events.empty()) return std::nullopt;
  if (hasConverged(a) != hasConverged(b))
    return changed(hasConverged(b), hasConverged(b) ? "converges now" : "no longer converges");
  const double lostA = figure(a, "lost_share");
  const double lostB = figure(b, "lost_share");
  if (std::abs(lostB - lostA) > 0.01)
    return changed(lostB < lostA, fmt::format("lost for {:.1f} % instead of {:.1f} % of the time",
                                              100.0 * lostB, 100.0 * lostA));
  const double p95A = figure(a, "position_p95_m");
  const double p95B = figure(b, "position_p95_m");
  if (std::abs(p95B - p95A) > std::max(0.05, 0.2 * std::min(p95A, p95B)))
    return changed(p95B < p95A, fmt::format("95 % of the errors below {:.3f} m instead of {:.3f} m",
                                            p95B, p95A));
  return std::nullopt;
}

std::string listed(const std::vector<std::string>& names, const std::string& head) {
  if (names.empty()) return "";
  std::string text = fmt::format("{}: {}\n", head, names.size());
  for (std::size_t i = 0; i < std::min(names.size(), kMostShown); ++i)
    text += "  " + printable(names[i]) + "\n";
  if (names.size() > kMostShown) text += fmt::format("  and {} more\n", names.size() - kMostShown);
  return text;
}

std::string changes(const Comparison& c, bool isBetter) {
  std::vector<std::string> lines;
  for (const ChangedRun& run : c.changed)
    if (run.isBetter == isBetter) lines.push_back(run.name + ": " + run.why);
  return listed(lines, isBetter ? "Better" : "Worse");
}

}  // namespace

Comparison compare(const std::vector<FiledRun>& before, const std::vector<FiledRun>& after) {
  Comparison comparison;
  const std::vector<Pair> pairs = pairsOf(before, after, comparison);
  compareSuccesses(pairs, comparison.successes);
  compareFigures(pairs, comparison.figures);
  for (const auto& [a, b] : pairs)
    if (auto changed = changeOf(*a, *b)) comparison.changed.push_back(std::move(*changed));
  std::ranges::stable_sort(comparison.changed, {}, &ChangedRun::isBetter);
  return comparison;
}

std::string toText(const Comparison& c) {
  std::string text = fmt::format("{} pairs of runs\n", c.pairs);
  if (!c.successes.empty())
    text += fmt::format("{:<28}{:>7}{:>9}{:>9}{:>8}{:>8}{:>10}\n", "success", "pairs", "A", "B",
                        "better", "worse", "p");
  for (const ComparedSuccess& s : c.successes)
    text += fmt::format("{:<28}{:>7}{:>9}{:>9}{:>8}{:>8}{:>10.2g}\n", s.name, s.pairs, s.before,
                        s.after, s.better, s.worse, s.p);
  if (!c.figures.empty())
    text += fmt::format("{:<28}{:>7}{:>9}{:>9}{:>8}{:>8}{:>10}\n", "figure, median", "pairs", "A",
                        "B", "better", "worse", "p");
  for (const ComparedFigure& f : c.figures)
    text += fmt::format("{:<28}{:>7}{:>9.4g}{:>9.4g}{:>8}{:>8}{:>10.2g}\n", f.name, f.pairs,
                        f.medianBefore, f.medianAfter, f.better, f.worse, f.p);
  text += changes(c, false) + changes(c, true);
  text += listed(c.onlyBefore, "Only in A") + listed(c.onlyAfter, "Only in B");
  return text +
         "p: McNemar's exact test of successes, Wilcoxon's signed-rank test of figures, two-sided; "
         "each on its own\n";
}

std::string toJson(const Comparison& c) {
  using Json = nlohmann::ordered_json;
  Json json = {{"pairs", c.pairs},         {"only_a", c.onlyBefore},
               {"only_b", c.onlyAfter},    {"successes", Json::array()},
               {"figures", Json::array()}, {"changed", Json::array()}};
  for (const ComparedSuccess& s : c.successes)
    json["successes"].push_back({{"name", s.name},
                                 {"pairs", s.pairs},
                                 {"a", s.before},
                                 {"b", s.after},
                                 {"better", s.better},
                                 {"worse", s.worse},
                                 {"p", s.p}});
  for (const ComparedFigure& f : c.figures)
    json["figures"].push_back({{"name", f.name},
                               {"pairs", f.pairs},
                               {"median_a", f.medianBefore},
                               {"median_b", f.medianAfter},
                               {"better", f.better},
                               {"worse", f.worse},
                               {"p", f.p}});
  for (const ChangedRun& run : c.changed)
    json["changed"].push_back({{"run", run.name}, {"better", run.isBetter}, {"why", run.why}});
  return jsonText(json);
}

}  // namespace ortung::app
