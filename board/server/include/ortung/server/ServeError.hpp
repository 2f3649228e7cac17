#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A request that can't be granted: becomes "ERR code text" on the wire.
class ORTUNG_API ServeError : public std::runtime_error {
 public:
  /// @param code one word for programs, such as "state" or "no-robot" (docs/protocol.md)
  /// @param text what is wrong and what would be right, for people
  ServeError(std::string code, const std::string& text)
      : std::runtime_error(text), code_(std::move(code)) {}
  ~ServeError() override;
  const std::string& code() const { return code_; }

 private:
  std::string code_;
};

}  // namespace ortung
