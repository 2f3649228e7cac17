#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "FieldSearch.hpp"
#include "News.hpp"
#include "PoseSearch.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// A start of which nothing is known: samples by what one moment's readings say, out of all poses
/// where the robot can stand. First the field is searched, and samples are drawn from around the
/// places that were found. Vague readings (one landmark, a range) fit in more places than those, or
/// in wider ones: then samples are drawn from candidates all over the floor, too.
///
/// A job that may be spread over updates: what is drawn does not depend on how much is done at a
/// time, nor on the number of threads. It speaks of the readings' moment. Not thread-safe.
class ORTUNG_API GlobalStart {
 public:
  /// Of the readings.
  struct Moment {
    Timestamp stamp = 0;
    std::optional<Pose2> odometry = {};
    std::uint64_t stream = 0;  ///< stream of random numbers
    std::vector<News> news = {};
  };

  /// All borrowed.
  GlobalStart(const MclConfig& config, const FieldRegion& region, const PoseSearch& search,
              Workers& workers);
  GlobalStart(const GlobalStart&) = delete;
  GlobalStart& operator=(const GlobalStart&) = delete;

  /// Makes what no reading is needed for; else begin() does.
  void prepare();
  void forget();
  bool isBegun() const { return moment_.has_value(); }
  /// @param moment with one reading at least
  void begin(Moment moment);
  /// Goes on for so long by the weighers' nominal times. No clock is asked.
  /// @returns whether it is done @pre isBegun()
  bool work(double nominalMilliseconds);
  const Moment& moment() const { return *moment_; }
  /// Once it is done, with what they weigh; then it is forgotten.
  SampleSet take();

 private:
  void beginAround();
  void beginBeside();
  bool drawOn(PoseSearch::Drawing& drawing, double& left) const;
  PoseSearch::Weigh weigher() const;
  PoseSearch::Weigh cautiousWeigher() const;
  std::vector<PoseSearch::Ring> found() const;
  bool areNotAll() const;
  double candidatesFor(std::size_t samples) const;

  const MclConfig& config_;
  const FieldRegion& region_;
  const PoseSearch& search_;
  Workers& workers_;
  std::optional<FieldSearch> field_;  ///< its cover is made once
  std::optional<Moment> moment_;
  double nanoseconds_ = 0.0;                   ///< time that drawing takes per pose [ns]
  bool isFound_ = false;                       ///< the places, by the search of the field
  std::vector<PoseSearch::Ring> rings_;        ///< around the places that were found
  std::optional<PoseSearch::Drawing> around_;  ///< drawing of the samples in these rings
  std::size_t beside_ = 0;                     ///< samples of all other poses, if they may matter
  std::optional<PoseSearch::Drawing> others_;  ///< drawing of the samples of all other poses
};

}  // namespace ortung
