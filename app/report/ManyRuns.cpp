#include "ManyRuns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "Console.hpp"
#include "RunJson.hpp"
#include "Statistics.hpp"
#include "ortung/base/Statistics.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kWhole = "whole";  ///< nameOf(RunKind::kWhole)

struct Share {
  std::size_t count = 0;
  std::size_t of = 0;
};

/// Quantiles of some values; NaN without values.
struct Spread {
  double p50 = kNan, p95 = kNan, p99 = kNan, most = kNan;
};

Spread spreadOf(const std::vector<double>& values) {
  return {quantile(values, 0.5), quantile(values, 0.95), quantile(values, 0.99),
          quantile(values, 1.0)};
}

/// A kept run whose figures are parsed.
struct Run {
  Json figures;
  const KeptRun* kept = nullptr;

  const Json& at(const char* key) const { return figures.at(key); }
  /// Returns a figure; NaN for null.
  double number(const char* key) const { return numberOf(at(key)); }
  std::size_t count(const char* key) const { return at(key).get<std::size_t>(); }
  std::string source() const { return at("source").get<std::string>(); }
  std::string kind() const {
    return figures.contains("case") ? at("case").at("kind").get<std::string>() : kWhole;
  }
  Json events() const { return figures.contains("case") ? at("case").at("events") : Json::array(); }
  static double numberOf(const Json& value) { return value.is_null() ? kNan : value.get<double>(); }
};

/// The summary of all runs of one source and kind.
struct Summary {
  std::string source;
  std::string kind;  ///< name of a RunKind
  std::size_t runs = 0;
  Share converged;  ///< runs that converged
  Share kept;       ///< runs that converged and were never lost after that
  Share right;      ///< events after which the estimate became right
  Spread position;  ///< position errors of all runs after convergence [m]
  double lostShare = kNan;
  double trackingShare = kNan;
  double wrongWhileTrackingShare = kNan;
  Share within;  ///< runs that were never beyond the protection level while tracking
  double beyondProtectionShare = kNan;
  double neesMean = kNan;
  Spread after;      ///< time until converged, or right again [s]
  Spread travelled;  ///< distance travelled until then [m]
  Spread readings;   ///< number of times with readings from events until then
  Spread updateMs;
};

/// Averages figures of runs, weighted by their duration.
class TimeMean {
 public:
  void add(double value, std::size_t weight) {
    if (!std::isfinite(value)) return;
    sum_ += value * static_cast<double>(weight);
    weight_ += static_cast<double>(weight);
  }
  double mean() const { return weight_ > 0.0 ? sum_ / weight_ : kNan; }

 private:
  double sum_ = 0.0;
  double weight_ = 0.0;
};

class Adding {
 public:
  explicit Adding(const Run& first) {
    summary_.source = first.source();
    summary_.kind = first.kind();
  }
  bool isOf(const Run& run) const {
    return run.source() == summary_.source && run.kind() == summary_.kind;
  }
  void add(const Run& run) {
    ++summary_.runs;
    const bool hasConverged = !run.at("converged_after_s").is_null();
    const double lostShare = run.number("lost_share");
    summary_.converged.count += hasConverged ? 1 : 0;
    summary_.kept.count += hasConverged && lostShare == 0.0 ? 1 : 0;
    errors_.insert(errors_.end(), run.kept->errors.begin(), run.kept->errors.end());
    updateMs_.insert(updateMs_.end(), run.kept->updateMs.begin(), run.kept->updateMs.end());
    lost_.add(lostShare, run.kept->errors.size());
    nees_.add(run.number("nees_mean"), run.kept->errors.size());
    addTracking(run);
    if (run.kind() == kWhole && hasConverged) {
      after_.push_back(run.number("converged_after_s"));
      travelled_.push_back(run.number("converged_after_m"));
    }
    for (const Json& event : run.events()) {
      ++summary_.right.of;
      if (!event.at("right").get<bool>()) continue;
      ++summary_.right.count;
      after_.push_back(event.at("after_s"));
      travelled_.push_back(event.at("after_m"));
      readings_.push_back(event.at("after_readings"));
    }
  }
  Summary summary() const {
    Summary s = summary_;
    s.converged.of = s.kept.of = s.runs;
    s.position = spreadOf(errors_);
    s.lostShare = lost_.mean();
    s.neesMean = nees_.mean();
    s.trackingShare = tracking_.mean();
    s.wrongWhileTrackingShare = wrongWhileTracking_.mean();
    s.beyondProtectionShare = beyondProtection_.mean();
    s.after = spreadOf(after_);
    s.travelled = spreadOf(travelled_);
    s.readings = spreadOf(readings_);
    s.updateMs = spreadOf(updateMs_);
    return s;
  }

 private:
  void addTracking(const Run& run) {
    const std::size_t moments = run.count("compared_moments");
    const double trackingShare = run.number("tracking_share");
    const double beyond = run.number("beyond_protection_share");
    tracking_.add(trackingShare, moments);
    wrongWhileTracking_.add(run.number("wrong_while_tracking_share"), moments);
    if (!std::isfinite(beyond)) return;
    ++summary_.within.of;
    summary_.within.count += beyond == 0.0 ? 1 : 0;
    const double tracked = trackingShare * static_cast<double>(moments);
    beyondProtection_.add(beyond, static_cast<std::size_t>(std::llround(tracked)));
  }

  Summary summary_;
  std::vector<double> errors_;
  std::vector<double> updateMs_;
  std::vector<double> after_;
  std::vector<double> travelled_;
  std::vector<double> readings_;
  TimeMean lost_;
  TimeMean nees_;
  TimeMean tracking_;
  TimeMean wrongWhileTracking_;
  TimeMean beyondProtection_;
};

/// Returns the summaries in the order of their first runs.
std::vector<Summary> summariesOf(const std::vector<Run>& runs) {
  std::vector<Adding> groups;
  for (const Run& run : runs) {
    auto group = groups.begin();
    while (group != groups.end() && !group->isOf(run)) ++group;
    if (group == groups.end()) group = groups.insert(groups.end(), Adding(run));
    group->add(run);
  }
  std::vector<Summary> summaries;
  summaries.reserve(groups.size());
  for (const Adding& group : groups) summaries.push_back(group.summary());
  return summaries;
}

Json jsonOf(const Share& share) {
  const Interval interval = wilson(share.count, share.of);
  const double rate =
      share.of > 0 ? static_cast<double>(share.count) / static_cast<double>(share.of) : kNan;
  return {{"count", share.count},
          {"of", share.of},
          {"share", jsonNumber(rate)},
          {"wilson95", {interval.low, interval.high}}};
}

Json jsonOf(const Spread& spread) {
  return {{"p50", jsonNumber(spread.p50)},
          {"p95", jsonNumber(spread.p95)},
          {"p99", jsonNumber(spread.p99)},
          {"max", jsonNumber(spread.most)}};
}

Json jsonOf(const Summary& s) {
  Json json = {{"source", s.source}, {"kind", s.kind}, {"runs", s.runs}};
  if (s.kind == kWhole) {
    json["converged"] = jsonOf(s.converged);
    json["never_lost"] = jsonOf(s.kept);
  } else {
    json["right"] = jsonOf(s.right);
  }
  json["after_s"] = jsonOf(s.after);
  json["after_m"] = jsonOf(s.travelled);
  if (s.kind != kWhole) json["after_readings"] = jsonOf(s.readings);
  json["position_m"] = jsonOf(s.position);
  json["lost_share"] = jsonNumber(s.lostShare);
  json["tracking_share"] = jsonNumber(s.trackingShare);
  json["wrong_while_tracking_share"] = jsonNumber(s.wrongWhileTrackingShare);
  json["beyond_protection_share"] = jsonNumber(s.beyondProtectionShare);
  json["never_beyond_protection"] = jsonOf(s.within);
  json["nees_mean"] = jsonNumber(s.neesMean);
  json["update_ms"] = jsonOf(s.updateMs);
  return json;
}

std::string line(const std::string& name, const std::string& value) {
  return fmt::format("  {:<34}{}\n", name, value);
}

std::string show(const Share& share) {
  const Interval interval = wilson(share.count, share.of);
  if (share.of == 0) return "- (none)";
  return fmt::format("{} of {}, {:.1f} % (95 %: {:.1f} to {:.1f})", share.count, share.of,
                     100.0 * static_cast<double>(share.count) / static_cast<double>(share.of),
                     100.0 * interval.low, 100.0 * interval.high);
}

std::string show(const Spread& spread, int digits, const char* unit) {
  if (!std::isfinite(spread.p50)) return "-";
  return fmt::format("{:.{}f}, {:.{}f}, {:.{}f}, {:.{}f}{}", spread.p50, digits, spread.p95, digits,
                     spread.p99, digits, spread.most, digits, unit);
}

std::string show(double value, int digits, const char* unit) {
  return std::isfinite(value) ? fmt::format("{:.{}f}{}", value, digits, unit) : "-";
}

std::string listOfCases(const std::vector<Run>& runs, const Summary& s) {
  std::string text;
  for (const Run& run : runs) {
    if (run.source() != s.source || run.kind() != s.kind) continue;
    for (const Json& event : run.events()) {
      const auto number = [&](const char* key) { return Run::numberOf(event.at(key)); };
      const std::string result =
          event.at("right").get<bool>()
              ? fmt::format("right after {:.1f} s, {:.1f} m, {} readings", number("after_s"),
                            number("after_m"), event.at("after_readings").get<std::size_t>())
              : "never right";
      text += fmt::format("    {} {} (seed {}), at {:.1f} s in ({:.2f}, {:.2f}) m: {}\n", s.kind,
                          run.at("case").at("number").get<std::size_t>(),
                          run.at("seed").get<std::uint64_t>(), number("at_s"), number("x_m"),
                          number("y_m"), result);
    }
  }
  return text;
}

std::string show(const std::vector<Run>& runs, const Summary& s) {
  const bool isWhole = s.kind == kWhole;
  std::string text = fmt::format("{}: {} {}\n", printable(s.source), s.runs,
                                 isWhole ? "runs" : printable(s.kind) + " runs");
  for (const Json& fault : runs.front().at("faults"))
    text += fmt::format("  with {}\n", printable(fault.get<std::string>()));
  text += isWhole ? line("Converged", show(s.converged)) +
                        line("Converged and never lost", show(s.kept))
                  : line("Right", show(s.right));
  text += line("After (p50, p95, p99, most)", show(s.after, 1, " s"));
  text += line("", show(s.travelled, 2, " m"));
  if (!isWhole) text += line("", show(s.readings, 0, " readings"));
  text += line("Position error", show(s.position, 3, " m"));
  text += line("Share of time lost", show(100.0 * s.lostShare, 2, " %"));
  text += line("Time with status tracking", show(100.0 * s.trackingShare, 2, " %"));
  text += line("... with an error above 1 m", show(100.0 * s.wrongWhileTrackingShare, 3, " %"));
  text += line("... with one beyond the bound", show(100.0 * s.beyondProtectionShare, 3, " %"));
  text += line("Runs never beyond it", show(s.within));
  text += line("Consistency (NEES, 3 is right)", show(s.neesMean, 2, ""));
  text += line("Time per update", show(s.updateMs, 3, " ms"));
  return text + listOfCases(runs, s);
}

std::vector<Run> parsed(const std::vector<KeptRun>& kept) {
  std::vector<Run> runs;
  runs.reserve(kept.size());
  for (const KeptRun& run : kept) runs.push_back({Json::parse(run.figures), &run});
  return runs;
}

/// Calls an action on the runs; figures of another kind become an error.
template <class Action>
std::string withParsed(const std::vector<KeptRun>& runs, const Action& action) {
  try {
    return action(parsed(runs));
  } catch (const Json::exception& error) {
    throw std::runtime_error(std::string("figures of a run can't be read: ") + error.what());
  }
}

std::vector<KeptRun> keptOf(const std::vector<RunResult>& runs) {
  std::vector<KeptRun> kept;
  kept.reserve(runs.size());
  for (const RunResult& run : runs) kept.push_back(keptOf(run));
  return kept;
}

}  // namespace

KeptRun keptOf(const RunResult& run) { return {toJson(run), run.errors, run.updateMs}; }

std::string toJson(const std::vector<KeptRun>& kept) {
  return withParsed(kept, [](std::vector<Run> runs) {
    std::size_t compared = 0;
    for (const Run& run : runs) compared += run.count("compared_steps");
    // This is the first key, so that the kind of file can be recognized by its beginning.
    Json json = {{"compared_steps", compared}, {"summary", Json::array()}, {"runs", Json::array()}};
    for (const Summary& summary : summariesOf(runs)) json["summary"].push_back(jsonOf(summary));
    for (Run& run : runs) json["runs"].push_back(std::move(run.figures));
    return jsonText(json);
  });
}

std::string toText(const std::vector<KeptRun>& kept) {
  return withParsed(kept, [](const std::vector<Run>& runs) {
    std::string text;
    for (const Summary& summary : summariesOf(runs)) text += show(runs, summary);
    return text;
  });
}

std::string toJson(const std::vector<RunResult>& runs) { return toJson(keptOf(runs)); }
std::string toText(const std::vector<RunResult>& runs) { return toText(keptOf(runs)); }

}  // namespace ortung::app
