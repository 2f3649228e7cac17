// The page of a sweep's table: curves as pictures within it, so that it needs no other file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "Axis.hpp"
#include "SweepTable.hpp"

namespace ortung::app {
namespace {

constexpr double kWidth = 640.0;
constexpr double kHeight = 320.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 170.0;
constexpr double kTop = 20.0;
constexpr double kBottom = 40.0;
constexpr std::array<const char*, 8> kColours = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd",
                                                 "#ff7f0e", "#8c564b", "#17becf", "#7f7f7f"};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::optional<double> numberIn(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// Returns the first key whose values are numbers, and more than one.
std::optional<std::size_t> axisOf(const SweepTable& table) {
  for (std::size_t k = 0; k < table.keys.size(); ++k) {
    bool areNumbers = true;
    bool differ = false;
    for (const SweepTable::Row& row : table.rows) {
      areNumbers = areNumbers && numberIn(row.values[k]).has_value();
      differ = differ || row.values[k] != table.rows.front().values[k];
    }
    if (areNumbers && differ) return k;
  }
  return std::nullopt;
}

struct Point {
  double x = 0.0;
  SweepTable::Cell cell;
};

/// The frame of a diagram.
struct Frame {
  double xLow = std::numeric_limits<double>::infinity();
  double xHigh = -std::numeric_limits<double>::infinity();
  double yLow = 0.0;
  double yHigh = 0.0;

  void add(const Point& point) {
    const double error = std::isfinite(point.cell.error) ? point.cell.error : 0.0;
    xLow = std::min(xLow, point.x);
    xHigh = std::max(xHigh, point.x);
    yLow = std::min(yLow, point.cell.mean - error);
    yHigh = std::max(yHigh, point.cell.mean + error);
  }
  double x(double value) const {
    return kLeft + (value - xLow) / std::max(xHigh - xLow, 1e-300) * (kWidth - kLeft - kRight);
  }
  double y(double value) const {
    return kHeight - kBottom -
           (value - yLow) / std::max(yHigh - yLow, 1e-300) * (kHeight - kTop - kBottom);
  }
};

std::string line(double x1, double y1, double x2, double y2, const char* colour) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2,
      y2, colour);
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(text));
}

std::string axes(const Frame& frame, const std::string& key) {
  std::string svg;
  for (const double tick : axisTicks(frame.xLow, frame.xHigh, 6)) {
    svg += line(frame.x(tick), kTop, frame.x(tick), kHeight - kBottom, "#ddd");
    svg += label(frame.x(tick), kHeight - kBottom + 14.0, "middle", fmt::format("{:g}", tick));
  }
  for (const double tick : axisTicks(frame.yLow, frame.yHigh, 6)) {
    svg += line(kLeft, frame.y(tick), kWidth - kRight, frame.y(tick), "#ddd");
    svg += label(kLeft - 6.0, frame.y(tick) + 4.0, "end", fmt::format("{:g}", tick));
  }
  return svg + label(0.5 * (kLeft + kWidth - kRight), kHeight - 6.0, "middle", key);
}

std::string curve(const Frame& frame, std::vector<Point> points, const char* colour) {
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  std::string path;
  std::string marks;
  for (const Point& point : points) {
    const double x = frame.x(point.x);
    path += fmt::format("{}{:.1f},{:.1f} ", path.empty() ? "" : "L", x, frame.y(point.cell.mean));
    marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", x,
                         frame.y(point.cell.mean), colour);
    if (!std::isfinite(point.cell.error)) continue;
    marks += line(x, frame.y(point.cell.mean - point.cell.error), x,
                  frame.y(point.cell.mean + point.cell.error), colour);
  }
  return fmt::format("<path d=\"M{}\" fill=\"none\" stroke=\"{}\"/>\n", path, colour) + marks;
}

/// Draws one figure over the key, a curve for each combination of the other values.
std::string diagram(const SweepTable& table, std::size_t key, std::size_t figure) {
  std::map<std::string, std::vector<Point>> curves;
  std::vector<std::string> order;
  Frame frame;
  for (const SweepTable::Row& row : table.rows) {
    if (!std::isfinite(row.cells[figure].mean)) continue;
    std::string name;
    for (std::size_t k = 0; k < row.values.size(); ++k)
      if (k != key) name += (name.empty() ? "" : ", ") + row.values[k];
    const Point point{*numberIn(row.values[key]), row.cells[figure]};
    if (!curves.contains(name)) order.push_back(name);
    curves[name].push_back(point);
    frame.add(point);
  }
  if (curves.empty()) return "";
  std::string svg =
      fmt::format("<h2>{}</h2>\n<svg viewBox=\"0 0 {:g} {:g}\" width=\"{:g}\" role=\"img\">\n",
                  escaped(table.figures[figure]), kWidth, kHeight, kWidth);
  svg += axes(frame, table.keys[key]);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const char* colour = kColours[i % kColours.size()];
    svg += curve(frame, curves[order[i]], colour);
    const double y = kTop + 14.0 * static_cast<double>(i + 1);
    if (order[i].empty() || y > kHeight - kBottom) continue;
    svg += line(kWidth - kRight + 8.0, y - 4.0, kWidth - kRight + 24.0, y - 4.0, colour);
    svg += label(kWidth - kRight + 28.0, y, "start", order[i]);
  }
  return svg + "</svg>\n";
}

std::string htmlTable(const SweepTable& table) {
  std::string html = "<table>\n<tr>";
  for (const std::string& key : table.keys) html += "<th>" + escaped(key) + "</th>";
  html += "<th>done</th>";
  for (const std::string& figure : table.figures) html += "<th>" + escaped(figure) + "</th>";
  html += "</tr>\n";
  for (const SweepTable::Row& row : table.rows) {
    html += "<tr>";
    for (const std::string& value : row.values) html += "<td>" + escaped(value) + "</td>";
    html += fmt::format("<td>{} of {}</td>", row.done, row.tasks);
    for (const SweepTable::Cell& cell : row.cells) {
      if (!std::isfinite(cell.mean))
        html += "<td>-</td>";
      else if (!std::isfinite(cell.error))
        html += fmt::format("<td>{:.4g}</td>", cell.mean);
      else
        html += fmt::format("<td>{:.4g} &plusmn; {:.2g}</td>", cell.mean, cell.error);
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string toHtml(const SweepTable& table, const std::string& title) {
  std::string html = "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Sweep " +
                     escaped(title) +
                     "</title>\n<style>body{font:15px sans-serif;margin:2em;max-width:60em}"
                     "td,th{padding:.2em .8em;text-align:right;border-bottom:1px solid #ddd}"
                     "table{border-collapse:collapse}svg text{font:11px sans-serif}</style>\n<h1>" +
                     escaped(title) + "</h1>\n";
  if (!table.missing.empty())
    html += fmt::format("<p>{} tasks have no result yet; what is there counts.</p>\n",
                        table.missing.size());
  html += htmlTable(table);
  if (const auto key = axisOf(table))
    for (std::size_t f = 0; f < table.figures.size(); ++f) html += diagram(table, *key, f);
  return html + "</html>\n";
}

}  // namespace ortung::app
