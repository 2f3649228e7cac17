#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <utility>

#include "IsOver.hpp"
#include "WorkTimes.hpp"
#include "ortung/base/Export.hpp"
#include "ortung/mcl/MclConfig.hpp"

namespace ortung {

/// How much of an update's time (MclConfig::budgetMs) is left, by the nominal times of the
/// weighers: no clock is read, so replays do the same in each update.
///
/// With a clock in addition (Mcl::keepTime) nothing that can wait begins unless it is over in time,
/// by how long such work has taken lately and by how long that takes which must follow. What has to
/// wait claims its time: the next update weighs fewer samples if it must. Not thread-safe.
class ORTUNG_API UpdateTime {
 public:
  /// One update, from its construction to its end.
  class Update {
   public:
    explicit Update(UpdateTime& time) { time.begin(); }
  };
  /// A step that can wait for another update. True: it begins, and goes on for this object's life.
  /// Always true without a clock.
  class ORTUNG_API Step {
   public:
    /// @param milliseconds time that it takes at most, by the clock
    Step(UpdateTime& time, Work work, double milliseconds);
    ~Step();
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;
    explicit operator bool() const { return begins_; }

   private:
    UpdateTime& time_;
    double begun_ = 0.0;
    double waited_ = 0.0;
    bool begins_ = true;
  };
  /// Work that is measured from its construction to its end, without the steps in it.
  class ORTUNG_API Measured {
   public:
    Measured(UpdateTime& time, Work work, double size);
    ~Measured();
    Measured(const Measured&) = delete;
    Measured& operator=(const Measured&) = delete;

   private:
    UpdateTime& time_;
    Work work_;
    double size_;
    double begun_ = 0.0;
    double waited_ = 0.0;
  };

  /// @param config borrowed
  explicit UpdateTime(const MclConfig& config) : config_(config) {}

  /// @param milliseconds clock that only goes forwards [ms]; null: there is none
  void keep(std::function<double()> milliseconds) { clock_ = std::move(milliseconds); }
  bool isKept() const { return static_cast<bool>(clock_); }
  void begin();
  void spend(double nominalNanoseconds) { spent_ += 1e-6 * nominalNanoseconds; }
  /// Returns the time left nominal time spent since begin() [ms]; it is always above zero, so that
  /// searches end.
  double left() const;

  // By the clock, all of them [ms].

  /// Returns the size of work on samples, part of which does not depend on their number.
  static double sizeOf(std::size_t samples) {
    return static_cast<double>(samples) + tuning::budget::kSamplesOfNone;
  }
  /// Says what must follow all that can wait.
  /// @param first first of the steps that follow; kEnd: none does
  /// @param samples of the belief
  void follows(Work first, std::size_t samples);
  /// Returns how long work takes at most, by what it has taken lately; 0: it was never done.
  double timeOf(Work work, double size = 1.0) const { return times_.of(work, size); }
  /// Returns how long it takes to draw and weigh poses at most. @param nanoseconds nominal time of
  /// a weigher
  double timeOfPoses(double poses, double nanoseconds) const;
  /// Returns whether there is time for something before what must follow.
  bool isTimeFor(double milliseconds) const;
  /// Returns how many poses there is time for.
  std::size_t posesInTime(double nanoseconds) const;
  /// Returns how long it takes to estimate from so many samples, and to resample them, at most.
  double timeToEstimate(std::size_t samples) const;
  /// Returns the greatest number of samples that leave time for anything else.
  std::size_t mostSamples() const;
  /// Returns what says that the time for weighing the belief is over: the rest is for what can
  /// wait, and for all that must follow. Null without a clock. It borrows this object, and is asked
  /// after each slice of the work, here and below.
  /// @param size nominal time of a slice [ms]
  IsOver endOfWeighing(double size);
  /// Returns what says that work ends that can wait for the next update, or do with less.
  IsOver endOf(Work work);
  /// Returns whether the whole budget has passed.
  bool isLate() const { return clock_ && passed() >= config_.budgetMs; }

 private:
  double passed() const { return clock_() - begun_; }
  double end() const;
  double firstGuess() const;
  double timeToEstimateEach() const;
  IsOver sliced(Work work, double size, double until);

  const MclConfig& config_;
  double spent_ = 0.0;  ///< nominal [ms]
  std::function<double()> clock_;
  double begun_ = 0.0;
  double follows_ = 0.0;  ///< what must follow
  double waited_ = 0.0;   ///< what steps that could have waited took in this update
  double claimed_ = 0.0;  ///< what they asked for in the last update
  double claims_ = 0.0;   ///< ... and in this one
  WorkTimes times_;
  std::array<int, static_cast<std::size_t>(Work::kEnd)> refused_{};  ///< times in a row
};

}  // namespace ortung
