#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "ortung/base/Export.hpp"

namespace ortung {

/// A request that can't be granted: becomes "ERR code text" on the wire.
class ORTUNG_API ServeError : public std::runtime_error {
 public:
  ServeError(std::string code, const std::string& text)
      : std::runtime_error(text), code_(std::move(code)) {}
  ~ServeError() override;
  const std::string& code() const { return code_; }

 private:
  std::string code_;
};

}  // namespace ortung
