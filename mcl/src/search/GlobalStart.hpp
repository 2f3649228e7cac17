#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "FieldSearch.hpp"
#include "NewReadings.hpp"
#include "PoseSearch.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/base/Pose2.hpp"
#include "ortung/base/Time.hpp"
#include "ortung/mcl/MclConfig.hpp"
#include "ortung/mcl/SampleSet.hpp"
#include "ortung/tables/FieldRegion.hpp"

namespace ortung {

/// Global localization: draws samples from the posterior of one time step's readings under a
/// uniform prior over all poses where the robot can stand. First the field is searched, and samples
/// are drawn around the places found. Vague readings (one landmark, a range) fit in more places
/// than those, or in wider ones: then samples are also drawn from candidates all over the floor.
///
/// It may be spread over several updates: the samples do not depend on how much is done in each,
/// nor on the number of threads. They are for the time of the readings. Not thread-safe.
class ORTUNG_API GlobalStart {
 public:
  /// The readings of one time step, and what is needed to draw by them.
  struct Moment {
    Timestamp stamp = 0;
    std::optional<Pose2> odometry = {};
    std::uint64_t stream = 0;  ///< stream of random numbers
    std::vector<NewReading> news = {};
  };

  /// All arguments are borrowed.
  GlobalStart(const MclConfig& config, const FieldRegion& region, const PoseSearch& search,
              Workers& workers);
  GlobalStart(const GlobalStart&) = delete;
  GlobalStart& operator=(const GlobalStart&) = delete;

  /// Does the preparations for which no reading is needed; otherwise begin() does them.
  void prepare();
  void forget();
  bool isBegun() const { return moment_.has_value(); }
  /// Begins a new start. @param moment it has at least one reading
  void begin(Moment moment);
  /// Continues for this long [ms] by the weighers' nominal times. No clock is read.
  /// @param isOver ends the work earlier; asked after each few poses
  /// @returns whether it is done @pre isBegun()
  bool work(double nominalMilliseconds, const IsOver& isOver = {});
  const Moment& moment() const { return *moment_; }
  /// Returns the number of samples. @pre work() has returned true
  std::size_t size() const;
  /// Returns the weighted samples, and forgets the start. @pre work() has returned true
  SampleSet take();

 private:
  void beginAround();
  bool gatherAround(const IsOver& isOver);
  bool gatherBeside(const IsOver& isOver);
  bool drawOn(PoseSearch::Drawing& drawing, double& left, const IsOver& isOver) const;
  PoseSearch::Weigh weigher() const;
  PoseSearch::Weigh cautiousWeigher() const;
  std::vector<PoseSearch::Ring> found() const;
  bool areNotAll() const;
  double candidatesFor(std::size_t samples) const;

  const MclConfig& config_;
  const FieldRegion& region_;
  const PoseSearch& search_;
  Workers& workers_;
  std::optional<FieldSearch> field_;  ///< its coarse grid of the field is made only once
  std::optional<Moment> moment_;
  double nanoseconds_ = 0.0;                   ///< time that drawing takes per pose [ns]
  bool isFound_ = false;                       ///< whether the search of the field is done
  std::vector<PoseSearch::Ring> rings_;        ///< neighbourhoods of the places that were found
  std::optional<PoseSearch::Inside> inside_;   ///< gathers candidates for them
  std::optional<PoseSearch::Drawing> around_;  ///< drawing of the samples in these rings
  /// Number of samples of all other poses; 0: they do not matter.
  std::size_t beside_ = 0;
  std::optional<PoseSearch::Beside> gathering_;
  std::optional<PoseSearch::Drawing> others_;  ///< drawing of the samples of all other poses
};

}  // namespace ortung
