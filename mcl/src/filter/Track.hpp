#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "Biases.hpp"
#include "Confirmation.hpp"
#include "GlobalStart.hpp"
#include "Hypothesis.hpp"
#include "Lateness.hpp"
#include "Lookalikes.hpp"
#include "Momentum.hpp"
#include "OdometryTrust.hpp"
#include "Polish.hpp"
#include "PoseSearch.hpp"
#include "Recovery.hpp"
#include "Rivals.hpp"
#include "SampleLimit.hpp"
#include "Separation.hpp"
#include "UpdateTime.hpp"
#include "ortung/base/Workers.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/PoseEstimate.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/motion/MotionModel.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// What the parts of a filter share during its lifetime; they borrow it.
struct Tools {
  Tools(const MclConfig& c, FieldRegion r, std::unique_ptr<MotionModel> m)
      : config((c.check(), c)),
        region((r.check(), std::move(r))),
        motion(std::move(m)),
        search(region),
        time(config),
        limit(config),
        workers(config.threads) {}

  MclConfig config;
  FieldRegion region;
  std::unique_ptr<MotionModel> motion;
  PoseSearch search;
  UpdateTime time;
  SampleLimit limit;
  Workers workers;
};

/// The distance travelled since the last weighing.
struct Travelled {
  double all = 0.0;     ///< distance and turns [m]; a turn of 1 rad counts as 1 m
  double metres = 0.0;  ///< distance travelled, without turns [m]
};

/// All that belongs to one belief. Another belief gets another track, so nothing of the old one is
/// left, even if members are added here.
struct Track {
  Track(Tools& tools, SampleSet samples, bool waits)
      : belief(std::move(samples)),
        waitsForStart(waits),
        momentum(tools.config),
        recovery(tools.config),
        rivals(tools.config, tools.region, tools.search, *tools.motion, tools.time, tools.workers),
        lookalikes(tools.region.building) {}

  /// Returns whether there are samples that may be reported.
  bool isKnown() const { return !waitsForStart && belief.samples().size() > 0; }

  Hypothesis belief;
  /// Estimate of the present samples; computed when it is needed.
  mutable std::optional<PoseEstimate> present;
  PoseResolution coarsest;  ///< coarsest resolution of the tables that weighed the belief last
  PoseDistance others;      ///< how far the belief reached at other places when it was weighed last
  bool waitsForStart;       ///< a global start waits for the first reading, or searches
  bool hasStarted = false;  ///< whether update() has yet to report an estimate
  Travelled travelled;
  bool isBlind = true;  ///< whether there is no trusted odometry up to this reading
  Momentum momentum;    ///< motion that is assumed without odometry
  OdometryTrust trust;
  SampleSet anchor;  ///< the belief when it was weighed last, while odometry is not trusted
  Recovery recovery;
  Rivals rivals;
  Lookalikes lookalikes;
  Confirmation confirmation;  ///< confirmation of the place that a global start has found
};

/// Parts that keep something when another belief begins, since it belongs to devices, sensors and
/// the map: delays, how consistent readings are, which devices there are, the coarse grid of the
/// floor.
struct LastingParts {
  Lateness lateness;
  Polish polish;
  Biases biases;
  Separation separation;
  GlobalStart globalStart;

  /// The parts that follow the estimate by odometry forget where it was, as something else than
  /// odometry moves the belief.
  void forgetPlace() {
    polish.forget();
    biases.forgetPlace();
    separation.forget();
  }
  /// Each part forgets what it knows of the belief. If a part is added, this does not compile until
  /// it is named here.
  void forget() {
    const auto forgetAll = [](auto&... each) { (each.forget(), ...); };
    auto& [first, second, third, fourth, fifth] = *this;
    forgetAll(first, second, third, fourth, fifth);
  }
};

}  // namespace ortung
