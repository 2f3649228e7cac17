#include "UpdateTime.hpp"

#include <algorithm>
#include <limits>

namespace ortung {

using namespace tuning::budget;

namespace {

constexpr std::array kFollowing = {Work::kClusters, Work::kLookalikes, Work::kEstimate,
                                   Work::kRefining, Work::kClosing,    Work::kResampling};

/// Returns how often work is refused in a row before it begins although it may be late, so that
/// nothing starves. A slice of a search is small, and a first estimate comes once.
int patienceFor(Work work) {
  return work == Work::kSearching || work == Work::kStart ? 1 : kPatience;
}

}  // namespace

void UpdateTime::begin() {
  spent_ = 0.0;
  if (!clock_) return;
  begun_ = clock_();
  follows_ = 0.0;
  waited_ = 0.0;
  claimed_ = std::exchange(claims_, 0.0);
}

double UpdateTime::left() const {
  return std::max(kShare * config_.budgetMs - spent_, kLeastShare * config_.budgetMs);
}

void UpdateTime::follows(Work first, std::size_t samples) {
  follows_ = 0.0;
  if (!clock_) return;
  for (const Work work : kFollowing)
    if (work >= first) follows_ += timeOf(work, work == Work::kRefining ? 1.0 : sizeOf(samples));
  if (first == Work::kClusters) follows_ = std::max(follows_, firstGuess() * sizeOf(samples));
}

/// Returns the time of all that follows the weighing of a sample while nothing of it is measured.
double UpdateTime::firstGuess() const {
  return times_.isMeasured(Work::kClusters) ? 0.0 : 1e-6 * kSampleNanoseconds;
}

double UpdateTime::timeOfPoses(double poses, double nanoseconds) const {
  return times_.of(Work::kWeighing, 1e-6 * poses * (nanoseconds + kPoseNanoseconds));
}

std::size_t UpdateTime::posesInTime(double nanoseconds) const {
  const double each = timeOfPoses(1.0, nanoseconds);
  if (!clock_ || each == 0.0) return std::numeric_limits<std::size_t>::max();
  return static_cast<std::size_t>(std::clamp((end() - passed()) / each, 0.0, 1e9));
}

bool UpdateTime::isTimeFor(double milliseconds) const {
  return !clock_ || passed() + milliseconds <= end();
}

double UpdateTime::timeToEstimateEach() const {
  double each = firstGuess();
  for (const Work work : kFollowing)
    if (work != Work::kRefining) each += timeOf(work);
  return each;
}

double UpdateTime::timeToEstimate(std::size_t samples) const {
  return clock_ ? timeToEstimateEach() * sizeOf(samples) + timeOf(Work::kRefining) : 0.0;
}

std::size_t UpdateTime::mostSamples() const {
  const double each = timeToEstimateEach();
  if (!clock_ || each == 0.0) return std::numeric_limits<std::size_t>::max();
  const double most = kMostToEstimate * config_.budgetMs / each - kSamplesOfNone;
  return static_cast<std::size_t>(std::clamp(most, 1.0, 1e9));
}

IsOver UpdateTime::endOfWeighing(double size) {
  if (!clock_) return {};
  const double all = end();
  const double claimed = std::clamp(claimed_, (1.0 - kShareOfWeighing) * all, kMostClaimed * all);
  return sliced(Work::kWeighing, size, all - claimed);
}

IsOver UpdateTime::endOf(Work work) {
  if (!clock_) return {};
  return sliced(work, 1.0, end());
}

/// Measures the time between two questions, and says whether there is not time for another slice.
IsOver UpdateTime::sliced(Work work, double size, double until) {
  return [this, work, size, until, before = passed()]() mutable {
    const double now = passed();
    times_.took(work, size, now - std::exchange(before, now));
    return now + timeOf(work, size) > until;
  };
}

double UpdateTime::end() const { return (1.0 - kMargin) * config_.budgetMs - follows_; }

UpdateTime::Step::Step(UpdateTime& time, Work work, double milliseconds) : time_(time) {
  if (!time_.clock_) return;
  time_.claims_ += milliseconds;
  int& refused = time_.refused_[static_cast<std::size_t>(work)];
  begins_ = time_.isTimeFor(milliseconds) || refused >= patienceFor(work);
  refused = begins_ ? 0 : refused + 1;
  begun_ = time_.passed();
  waited_ = time_.waited_;
}

UpdateTime::Step::~Step() {
  // What steps within this one took is part of it.
  if (time_.clock_ && begins_) time_.waited_ = waited_ + time_.passed() - begun_;
}

UpdateTime::Measured::Measured(UpdateTime& time, Work work, double size)
    : time_(time), work_(work), size_(size) {
  if (!time_.clock_) return;
  begun_ = time_.passed();
  waited_ = time_.waited_;
}

UpdateTime::Measured::~Measured() {
  if (!time_.clock_) return;
  time_.times_.took(work_, size_, time_.passed() - begun_ - (time_.waited_ - waited_));
}

}  // namespace ortung
