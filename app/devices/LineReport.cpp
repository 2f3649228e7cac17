#include "LineReport.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "Console.hpp"
#include "ortung/base/Angles.hpp"

namespace ortung::app {
namespace {

using Json = nlohmann::ordered_json;

std::string boundOf(const Check& check) {
  return fmt::format("{} {:.{}f} {}", check.isAtLeast ? "at least" : "at most", check.needed,
                     check.digits, check.unit);
}

std::string figureOf(const Check& check) {
  return std::isinf(check.found) ? check.isAtLeast ? "none" : "unknown"
                                 : fmt::format("{:.{}f}", check.found, check.digits);
}

std::string picturesText(const LineResult& result) {
  std::string text = fmt::format("{:<44} {:>6} {:>9} {:>10} {:>8}   pose on the field\n", "picture",
                                 "points", "within 5m", "median [m]", "matched");
  for (std::size_t i = 0; i < result.pictures.size(); ++i) {
    const LinePictureFit& fit = result.calibration.pictures[i];
    text +=
        fmt::format("{:<44} {:>6} {:>9} {:>10} {:>7.0f}%   {:.2f} m, {:.2f} m, {:.0f} degrees{}\n",
                    printable(result.pictures[i].filename().string()), result.points[i], fit.points,
                    fit.points > 0 ? fmt::format("{:.3f}", fit.median) : "-",
                    100.0 * fit.matchedShare, fit.pose.x, fit.pose.y, degrees(fit.pose.theta),
                    fit.place.verdict.isDetermined() ? "" : ", not determined");
  }
  return text;
}

std::string reasonsText(const LineResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.pictures.size(); ++i)
    for (const Check& check : result.calibration.pictures[i].place.verdict.checks)
      if (!check.isMet())
        text += fmt::format("{}: pose not determined: {} {}, needed {}\n",
                            printable(result.pictures[i].filename().string()), check.name,
                            figureOf(check), boundOf(check));
  return text;
}

Json toJson(const Verdict& verdict) {
  Json checks = Json::array();
  // JSON has no infinity: null says that there is no such figure.
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  for (const Check& c : verdict.checks)
    checks.push_back({{"name", c.name},
                      {"found", number(c.found)},
                      {c.isAtLeast ? "at_least" : "at_most", c.needed},
                      {"unit", c.unit},
                      {"met", c.isMet()}});
  return {
      {"determined", verdict.isDetermined()}, {"sentence", verdict.sentence()}, {"checks", checks}};
}

Json toJson(const LinePictureFit& fit) {
  Json out = {{"x_m", fit.pose.x}, {"y_m", fit.pose.y}, {"heading_deg", degrees(fit.pose.theta)}};
  out["sigmas"] = {fit.place.sigmas[0], fit.place.sigmas[1], degrees(fit.place.sigmas[2])};
  out["points_within_5_m"] = fit.points;
  out["median_m"] = fit.median;
  out["matched_share"] = fit.matchedShare;
  out["lines_m"] = {{"found", fit.inSight.found},
                    {"missing", fit.inSight.missing},
                    {"hidden", fit.inSight.hidden}};
  out["marks"] = {{"found", fit.inSight.marksFound}, {"missing", fit.inSight.marksMissing}};
  out["verdict"] = toJson(fit.place.verdict);
  return out;
}

}  // namespace

std::string toText(const Verdict& verdict) {
  std::string text = fmt::format("\n{:<44} {:>8}   {:<18}\n", "check", "found", "needed");
  for (const Check& check : verdict.checks)
    text += fmt::format("{:<44} {:>8}   {:<18} {}\n", check.name, figureOf(check), boundOf(check),
                        check.isMet() ? "met" : "NOT MET");
  return text + fmt::format("verdict: {}\n\n", verdict.sentence());
}

std::string toText(const LineResult& result, bool namesWorld) {
  const LineCalibration& c = result.calibration;
  std::string text = picturesText(result) + reasonsText(result);
  if (namesWorld) text += fmt::format("fits best: {}\n", result.world);
  text += fmt::format("height {:.3f} m, tilt {:.2f} degrees, roll {:.2f} degrees\n\n",
                      c.view.place().z, degrees(c.view.place().tilt), degrees(c.view.place().roll));
  text += fmt::format("{:<14} {:>10} {:>10}   expected before\n", "setting", "value", "sigma");
  for (const LineSetting& s : c.settings)
    text += fmt::format("{:<14} {:>10.4g} {:>10.2g}   {:.4g}, sigma {:.2g}\n", s.name, s.value,
                        s.sigma, s.expected, s.expectedSigma);
  return text + toText(c.verdict);
}

std::string toJson(const LineResult& result) {
  const LineCalibration& c = result.calibration;
  Json out = toJson(c.verdict);
  out["world"] = result.world;
  out["rival"] = nullptr;
  if (std::isfinite(c.rivalCost))
    out["rival"] = {{"cost", c.rivalCost}, {"focal_px", c.rivalFocal}};
  out["settings"] = Json::array();
  for (const LineSetting& s : c.settings)
    out["settings"].push_back({{"name", s.name},
                               {"value", s.value},
                               {"sigma", s.sigma},
                               {"expected", s.expected},
                               {"expected_sigma", s.expectedSigma}});
  const std::size_t n = c.settings.size();
  out["covariance"] = Json::array();
  for (std::size_t row = 0; row < n; ++row) {
    const auto begin = c.covariance.begin() + static_cast<std::ptrdiff_t>(row * n);
    out["covariance"].push_back(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(n)));
  }
  out["pictures"] = Json::array();
  for (std::size_t i = 0; i < result.pictures.size(); ++i) {
    Json picture = {{"file", result.pictures[i].filename().string()}};
    picture.update(toJson(c.pictures[i]));
    out["pictures"].push_back(picture);
  }
  // A file's name may have bytes that are no text.
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ortung::app
