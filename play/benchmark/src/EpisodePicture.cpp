#include "EpisodePicture.hpp"

#include <algorithm>
#include <cstdio>

namespace ortung {
namespace {

// The part of the field that is shown [m]. The goal is at the bottom, so the field's y axis points
// to the right.
constexpr double kDeepest = -6.9;  // behind the goal
constexpr double kFarthest = 1.2;
constexpr double kAside = 4.2;
constexpr double kKeeper = 0.225;  // half a body [m]
constexpr double kStriker = 0.25;

std::string format(const char* form, double a, double b = 0.0, double c = 0.0, double d = 0.0) {
  char text[160];
  std::snprintf(text, sizeof text, form, a, b, c, d);
  return text;
}

double across(double y) { return y; }
double down(double x) { return -x; }

/// Returns the path of the ball or a robot; points within 2 cm of the previous one are left out.
template <class Where>
std::string way(const std::vector<GoalMoment>& moments, const char* style, const Where& where) {
  std::string text = std::string("<polyline class=\"") + style + "\" points=\"";
  Pose2 last{1e9, 0.0, 0.0};
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Pose2 at = where(moments[i]);
    if (distance(at, last) < 0.02 && i + 1 < moments.size()) continue;
    text += format("%.2f,%.2f ", across(at.y), down(at.x));
    last = at;
  }
  return text + "\"/>";
}

std::string body(const Pose2& pose, double half, const char* style) {
  return format("<rect x=\"%.3f\" y=\"%.3f\" width=\"%.3f\" height=\"%.3f\"", -half, -half,
                2 * half, 2 * half) +
         format(" transform=\"translate(%.3f %.3f) rotate(%.1f)\"", across(pose.y), down(pose.x),
                90.0 - pose.theta * 57.29577951308232) +
         " class=\"" + style + "\"/>";
}

std::string field() {
  return "<path class=\"line\" d=\"M-4 -1.2V6H4V-1.2M-2.5 6V4.5H2.5V6M-1.5 6V5.5H1.5V6M-4 0H4\"/>"
         "<path class=\"goal\" d=\"M-1 6V6.5H1V6\"/>";
}

}  // namespace

std::string pictureOf(const std::vector<GoalMoment>& moments, const std::string& title) {
  std::string svg = format("<svg viewBox=\"%.2f %.2f %.2f %.2f\" role=\"img\">", -kAside,
                           -kFarthest, 2.0 * kAside, kFarthest - kDeepest) +
                    "<title>" + title + "</title>" + field();
  if (moments.empty()) return svg + "</svg>";
  const GoalMoment& first = moments[std::min<std::size_t>(1, moments.size() - 1)];
  const GoalMoment& last = moments.back();
  const std::vector<GoalMoment> played(moments.begin() + (moments.size() > 1 ? 1 : 0),
                                       moments.end());
  svg += way(played, "striker", [](const GoalMoment& m) { return m.striker; });
  svg += way(played, "keeper", [](const GoalMoment& m) { return m.keeper; });
  svg += way(played, "ball", [](const GoalMoment& m) { return m.ball; });
  svg += body(first.keeper, kKeeper, "keeper from") + body(last.keeper, kKeeper, "keeper body");
  svg += body(last.striker, kStriker, "striker body");
  svg += format("<circle class=\"ball from\" cx=\"%.2f\" cy=\"%.2f\" r=\"0.11\"/>",
                across(first.ball.y), down(first.ball.x));
  svg += format("<circle class=\"ball body\" cx=\"%.2f\" cy=\"%.2f\" r=\"0.11\"/>",
                across(last.ball.y), down(last.ball.x));
  return svg + "</svg>";
}

}  // namespace ortung
