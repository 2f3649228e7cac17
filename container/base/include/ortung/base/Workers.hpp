#pragma once

#include <functional>
#include <memory>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A pool of threads that share equal pieces of work. One caller at a time.
class ORTUNG_API Workers {
 public:
  /// @param threads at least 1, with the caller's own
  explicit Workers(unsigned threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Calls work(i) once for each i in [0, n), in any order, and returns when all are done.
  /// @pre work does not throw
  void run(std::size_t n, const std::function<void(std::size_t)>& work);

 private:
  struct Crew;
  std::unique_ptr<Crew> crew_;
};

}  // namespace ortung
