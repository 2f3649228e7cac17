#include "Report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "Assets.hpp"
#include "PathSvg.hpp"
#include "TimeGaps.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::app {
namespace {

constexpr std::size_t kMaxChartPoints = 8000;  ///< greatest number of points of a chart

/// Appends a number as JSON.
void append(std::string& json, double value) {
  if (std::isfinite(value)) {
    fmt::format_to(std::back_inserter(json), "{:.5g},", value);
  } else {
    json += "null,";
  }
}

/// Returns a JSON array with a number for each element.
template <class Element, class Number>
std::string jsonArray(const std::vector<Element>& elements, Number number) {
  std::string json = "[";
  for (const Element& element : elements) append(json, number(element));
  if (json.back() == ',') json.pop_back();
  return json + "]";
}

/// Returns the element with the greatest value of each bucket, so that no peak is lost.
template <class Element, class Value>
std::vector<Element> thin(const std::vector<Element>& elements, Value value) {
  const std::size_t bucket = elements.size() / kMaxChartPoints + 1;
  std::vector<Element> kept;
  for (std::size_t i = 0; i < elements.size(); i += bucket) {
    const auto begin = elements.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end =
        elements.begin() + static_cast<std::ptrdiff_t>(std::min(i + bucket, elements.size()));
    kept.push_back(*std::max_element(
        begin, end, [&](const Element& a, const Element& b) { return value(a) < value(b); }));
  }
  return kept;
}

/// Appends a member with the names of an enumeration that counts from 0.
template <class Value>
std::string namesOf(const char* member, Value last) {
  std::string json = fmt::format("\"{}\":[", member);
  for (int i = 0; i <= static_cast<int>(last); ++i)
    json += fmt::format("{}\"{}\"", i == 0 ? "" : ",", nameOf(static_cast<Value>(i)));
  return json + "],";
}

/// Returns the bound of each point: the newest one up to its time; an empty array without bounds.
template <class Number>
std::string boundsOf(const std::vector<EvaluationPoint>& points,
                     const std::vector<PoseBound>& bounds, Number number) {
  if (bounds.empty()) return "[]";
  return jsonArray(points, [&](const EvaluationPoint& p) {
    const auto after =
        std::upper_bound(bounds.begin(), bounds.end(), p.stamp,
                         [](Timestamp stamp, const PoseBound& b) { return stamp < b.stamp; });
    return after == bounds.begin() ? std::nan("") : number(std::prev(after)->covariance);
  });
}

/// Returns the data that report.js draws.
std::string chartData(const RunResult& run) {
  const auto points = thin(run.figures.points, [](const auto& p) { return p.positionError; });
  const auto estimates = thin(run.estimates, [](const auto& e) { return e.samples; });
  const auto path = thin(run.path, [](const PoseEstimate& e) {
    return 2.0 * static_cast<double>(e.status) - e.quality;  // greatest for the least trusted one
  });
  const auto time = [&](Timestamp stamp) { return toSeconds(stamp) - toSeconds(run.first); };
  std::string json = "{";
  const auto member = [&](const char* name, const std::string& array) {
    json += fmt::format("\"{}\":{},", name, array);
  };
  using Point = EvaluationPoint;
  member("time", jsonArray(points, [&](const Point& p) { return time(p.stamp); }));
  member("position", jsonArray(points, [](const Point& p) { return p.positionError; }));
  member("positionSigma", jsonArray(points, [](const Point& p) {
           return std::sqrt(positionVariance(p.covariance));
         }));
  member("heading", jsonArray(points, [](const Point& p) { return degrees(p.headingError); }));
  member("headingSigma", jsonArray(points, [](const Point& p) {
           return degrees(std::sqrt(headingVariance(p.covariance)));
         }));
  member("positionBound", boundsOf(points, run.bounds, [](const auto& covariance) {
           return std::sqrt(positionVariance(covariance));
         }));
  member("headingBound", boundsOf(points, run.bounds, [](const auto& covariance) {
           return degrees(std::sqrt(headingVariance(covariance)));
         }));
  member("truthX", jsonArray(points, [](const Point& p) { return p.truth.x; }));
  member("truthY", jsonArray(points, [](const Point& p) { return p.truth.y; }));
  member("estimateX", jsonArray(points, [](const Point& p) { return p.estimate.x; }));
  member("estimateY", jsonArray(points, [](const Point& p) { return p.estimate.y; }));
  member("samplesTime", jsonArray(estimates, [&](const auto& e) { return time(e.stamp); }));
  member("samples", jsonArray(estimates, [](const auto& e) { return double(e.samples); }));
  member("pathTime", jsonArray(path, [&](const auto& e) { return time(e.stamp); }));
  member("quality", jsonArray(path, [](const auto& e) { return e.quality; }));
  member("status", jsonArray(path, [](const auto& e) { return double(e.status); }));
  member("reason", jsonArray(path, [](const auto& e) { return double(e.reason); }));
  json += namesOf<TrackStatus>("statusNames", TrackStatus::kLast) +
          namesOf<TrackReason>("reasonNames", TrackReason::kLast);
  json += fmt::format(
      "\"longestStep\":{:.3f},\"longestSamplesStep\":{:.3f},\"longestPathStep\":{:.3f},",
      longestDrawnStepOf(points), longestDrawnStepOf(estimates),
      std::max(longestDrawnStepOf(path), longestPathStep(run)));
  const auto& converged = run.figures.convergedAfter;
  return json + "\"converged\":" + (converged ? fmt::format("{:.3f}", *converged) : "null") + "}";
}

std::string card(const Figure& figure) {
  return fmt::format(R"(<div class="card"><b>{}</b><span>{}</span></div>)",
                     escapeHtml(figure.value), escapeHtml(figure.name));
}

std::string row(const std::string& name, const std::string& value) {
  return fmt::format("<tr><th>{}</th><td>{}</td></tr>", escapeHtml(name), escapeHtml(value));
}

std::string legend(bool hasTruth, const RunResult& run) {
  const FieldModel& field = run.tableInfo.field;
  std::string html =
      R"(<p class="legend">estimate, its quality: 0 )" + qualityBar() +
      R"( 1 <span class="key uncertain"></span>uncertain <span class="key lost"></span>lost)";
  if (hasTruth) {
    html += R"( <span class="key truth"></span>ground truth <span class="key start"></span>start)"
            R"( <span class="key end"></span>end)";
  }
  if (!field.landmarks.empty()) html += R"( <span class="key landmark"></span>landmark)";
  if (!field.lines.empty()) html += R"( <span class="key line"></span>line on the floor)";
  if (run.changes.sure(MapChange::Kind::kGone) > 0)
    html += R"( <span class="key gone"></span>wall that is gone)";
  if (run.changes.sure(MapChange::Kind::kNew) > 0) html += R"( <span class="key fresh"></span>new)";
  return html + R"( <span class="key tight"></span>too tight for the robot)"
                R"( <span class="key solid"></span>solid, unknown or outside</p>)";
}

/// Returns a heading and a place for a chart.
std::string chart(const char* id, const char* name, const std::string& unit,
                  const std::string& about) {
  return fmt::format(
      R"(<h2>{1} <small>{2}</small></h2><div id="{0}" class="chart" role="img" aria-label="{1} over time. {3}"></div>)",
      id, name, unit, escapeHtml(about));
}

std::string charts(const RunResult& run) {
  std::string html = R"(<section class="charts">)";
  const auto figure = [&](const char* name) {
    for (const Figure& one : figuresOf(run))
      if (one.name.starts_with(name)) return fmt::format("{}: {}.", one.name, one.value);
    return std::string();
  };
  if (!run.figures.points.empty()) {
    const std::string about = std::string("with the filter's estimate of 1 sigma") +
                              (run.bounds.empty() ? "" : " and its lower bound (green)");
    html += chart("position", "Position error", "m, " + about, figure("Position error, RMS"));
    html += chart("heading", "Heading error", "degrees, " + about, figure("Heading error, RMS"));
  } else {
    html +=
        R"(<p class="note">The source has no ground truth, so there are no errors to show.</p>)";
  }
  html += chart("quality", "Quality",
                "probability of an error below 0.5 m; bands: uncertain (low), lost (high)",
                figure("Time with status tracking"));
  html += chart("samples", "Samples", "logarithmic", figure("Samples, mean"));
  return html +
         R"(<p class="note">Time is in seconds since the first reading. Before convergence (grey) errors may lie above the chart. Lines are broken where there are no data. Above a chart are its values at the time under the pointer, and the map shows the robot then. Drag to zoom, with Shift to move along; double-click to zoom out.</p></section>)";
}

std::string settings(const RunResult& run) {
  const FieldGrid& grid = run.tableInfo.region.grid;
  return row("Source", run.figures.source) + row("Robot", run.robot) + row("Tables", run.tables) +
         row("World", run.tableInfo.world + " (" + run.tableInfo.worldFingerprint + ")") +
         row("Cells", fmt::format("{} x {} of {:g} m", grid.columns, grid.rows, grid.cell)) +
         row("Greatest number of samples", fmt::format("{}", run.particles)) +
         row("Seed", fmt::format("{}", run.seed));
}

std::string head(const std::string& title) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"color-scheme\" content=\"light dark\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'\">"
      "<title>{}</title>\n<style>{}\n{}</style></head>\n",
      escapeHtml(title), assets::uPlotStyle(), assets::reportStyle());
}

std::string body(const RunResult& run) {
  const bool hasTruth = !run.figures.points.empty();
  const std::vector<Figure> figures = figuresOf(run);
  std::string cards;
  for (const char* name : {"Position error, RMS", "Position error, median", "Heading error, RMS",
                           "Converged after", "Time per update, median"}) {
    for (const Figure& figure : figures) {
      if (figure.name == name) cards += card(figure);
    }
  }
  std::string rows;
  for (const Figure& figure : figures) rows += row(figure.name, figure.value);
  return fmt::format(
      "<body><header><h1>Localization run</h1><p>{}</p></header>\n"
      "<section class=\"cards\">{}</section>\n"
      "<section class=\"map\"><h2>Map and paths</h2>{}{}</section>\n{}\n"
      "<section class=\"tables\"><div><h2>Figures</h2><table>{}</table>"
      "<p class=\"note\">Errors are over the time after convergence.</p></div>"
      "<div><h2>Run</h2><table>{}</table><h2>Command line</h2><pre>{}</pre></div></section>\n"
      "<footer>Made by ortung. Charts: <a href=\"https://github.com/leeoniya/uPlot\">uPlot</a>, "
      "MIT licence.</footer>\n",
      escapeHtml(run.figures.source), cards, mapSvg(run), legend(hasTruth, run), charts(run), rows,
      settings(run), escapeHtml(run.commandLine));
}

}  // namespace

std::string escapeHtml(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string toHtml(const RunResult& run) {
  std::string html = head("ortung: " + run.figures.source) + body(run);
  // The data are numbers only, so they can't end their element early.
  html += "<script type=\"application/json\" id=\"data\">" + chartData(run) + "</script>\n";
  html.append("<script>/*\n").append(assets::uPlotLicence()).append("\n*/\n");
  html.append(assets::uPlotScript()).append("</script>\n");
  html.append("<script>").append(assets::reportScript()).append("</script>\n");
  return html + "</body></html>\n";
}

}  // namespace ortung::app
