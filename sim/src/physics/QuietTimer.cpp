// Box2D reads the clock a dozen times in each step, for a profile that nobody here looks at: a
// sixth of the time of a small world. These are its timer's functions without a clock. The dynamic
// linker finds them before Box2D's own, since this library is loaded before it; where another order
// wins, Box2D is only slower.
#include <box2d/b2_timer.h>

b2Timer::b2Timer() { Reset(); }

void b2Timer::Reset() {
  m_start_sec = 0;
  m_start_usec = 0;
}

float b2Timer::GetMilliseconds() const { return 0.0f; }
