#pragma once

#include <cstddef>
#include <deque>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// Estimates how a server's clock relates to ours, from exchanges of time stamps over a network
/// (paper, section 2.2). An exchange gives our time at one time of the server's with an error of at
/// most half its round trip, so the shortest one is the most precise; older ones give the rate of
/// the server's clock. Not thread-safe.
class ORTUNG_API ClockOffset {
 public:
  /// One question and its answer. Travel and waiting in between are unknown, so the offset is known
  /// within half the round trip.
  struct Exchange {
    Timestamp sent = 0;      ///< departure of the question, on our clock [us]
    Timestamp received = 0;  ///< arrival at the server, on its clock [us]
    Timestamp answered = 0;  ///< departure of the answer, on the server's clock [us]
    Timestamp back = 0;      ///< arrival of the answer, on our clock [us]
  };

  /// Adds an exchange, later than all before. If it contradicts those before (the server's clock
  /// was paused or set), they are dropped. Stamps that are impossible are ignored.
  void add(const Exchange& exchange);

  /// Whether an exchange was added since the last contradiction.
  bool isKnown() const { return !readings_.empty(); }
  /// Our time when the server's clock showed @p server, within what a Timestamp can hold.
  /// @pre isKnown()
  Timestamp toLocal(Timestamp server) const;
  /// How far toLocal(@p server) may be off [us], while the server's clock keeps its rate.
  double bound(Timestamp server) const;
  /// Our seconds for each of the server's.
  double rate() const { return rate_; }

 private:
  struct Reading {
    double local;   ///< our time half way between sent and back [us]
    double server;  ///< the server's time half way between received and answered [us]
    double error;   ///< half the time that went by on the network [us]
  };
  double errorAt(const Reading& reading, double server) const;
  const Reading& best(double server) const;
  void startOver(const Reading& reading);
  void estimateRate();

  std::deque<Reading> readings_;
  double rate_ = 1.0;
  double rateError_ = 0.0;
};

}  // namespace ortung
