#pragma once

#include <cstdint>
#include <optional>

#include "ortung/base/Export.hpp"
#include "ortung/base/Time.hpp"

namespace ortung {

/// How the time of a served world passes. A part of ServedWorld, as which it is called.
class ORTUNG_API ServedTime {
 public:
  virtual ~ServedTime();

  /// Stamp of the readings that the next step gives; if it is live, the time of its clock.
  virtual Timestamp now() const = 0;
  /// How long the board waits between two steps of a world whose time goes on whatever the board
  /// does [us]: a live one, such as a running robot. It can't be paused, made faster, reset, or
  /// joined by robots of clients. 0: its time is the board's.
  virtual Timestamp livePeriod() const = 0;
  /// Whether it may begin.
  virtual bool isReady() const = 0;
  /// Whether there is nothing left to step to.
  virtual bool isAtEnd() const = 0;
  /// One cycle. @throws std::runtime_error if the world can't go on
  virtual void step() = 0;

  /// Goes to a time of its time line [us]; readings() are then what was newest there. What lies
  /// before or behind becomes its beginning or end.
  virtual void seek(Timestamp stamp) = 0;
  /// Seed of its random numbers; nothing: it has none.
  virtual std::optional<std::uint64_t> seed() const = 0;
  /// Starts over: time, random numbers and robots are as at their beginning.
  virtual void reset(std::optional<std::uint64_t> seed) = 0;
};

}  // namespace ortung
