#include "PluginSentences.hpp"

#include <algorithm>
#include <array>

namespace ortung::app {
namespace {

struct Sentence {
  std::string_view kind;
  std::string_view name;
  std::string_view text;
};

constexpr std::array kSentences = {
    Sentence{"sensor", "camera",
             "pictures of any camera, from which image_features makes readings"},
    Sentence{"sensor", "compass", "the direction of north, by a magnetic needle"},
    Sentence{"sensor", "ground_truth", "the true pose, which evaluations alone look at"},
    Sentence{"sensor", "iconic_camera",
             "balls, robots, goals and posts that a camera sees in front"},
    Sentence{"sensor", "iconic_omnivision",
             "balls, robots, goals and posts that a camera sees all around"},
    Sentence{"sensor", "image_features",
             "lines, balls and goals in the pictures of a calibrated camera"},
    Sentence{"sensor", "landmarks", "distance and bearing of landmarks, told apart or not"},
    Sentence{"sensor", "lrf", "distances by a laser that sweeps a plane: scanners, lidars"},
    Sentence{"sensor", "lrf_cylinders", "columns, posts and trees, found in a laser scan"},
    Sentence{"sensor", "lrf_iconic",
             "what a program reports of a laser scan: obstacles, a position"},
    Sentence{"sensor", "odometry", "the way driven, by the wheels"},
    Sentence{"sensor", "sonar", "distances by ultrasound, each within a cone; a ring of them"},
    Sentence{"sensor", "teammate", "poses and balls that other robots of the team tell by radio"},
    Sentence{"motion", "differential", "errors of two driven wheels: turn, way, turn"},
    Sentence{"motion", "neural", "a network that train-motion has fitted to logs of a base"},
    Sentence{"motion", "odometry", "errors of turns and ways of any base; the default"},
    Sentence{"motion", "omni", "errors of a base that drives in every direction alike"},
    Sentence{"drive", "differential", "two driven wheels on an axle; the default"},
    Sentence{"drive", "neural", "a base as a network has learned it from logs"},
    Sentence{"drive", "omni", "three wheels that roll in every direction"},
    Sentence{"referee", "soccer", "the rules of robot soccer, of the leagues in maps/rules"},
    Sentence{"device", "base", "a base that tells its odometry over a serial line"},
    Sentence{"device", "camera", "a camera that the system knows as a video device"},
    Sentence{"device", "hokuyo", "a Hokuyo scanner that speaks SCIP"},
    Sentence{"device", "lines", "readings as lines of text, from a serial line or a socket"},
    Sentence{"device", "sick_lms", "a SICK LMS scanner on a serial line"},
};

}  // namespace

std::string_view sentenceOf(std::string_view kind, std::string_view name) {
  const auto found = std::find_if(kSentences.begin(), kSentences.end(), [&](const Sentence& one) {
    return one.kind == kind && one.name == name;
  });
  return found == kSentences.end() ? "" : found->text;
}

}  // namespace ortung::app
