#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "ortung/core/SensorData.hpp"

namespace ortung::test {

/// A class that nobody knows, with the format of another one.
class StrangerData : public SensorData {
 public:
  explicit StrangerData(const std::string& format, const Pose2& mount = {})
      : SensorData({"acme", "unheard-of", "thing"}, mount), format_(parseFormat(format)) {}
  Format format() const override { return format_; }
  std::string wordsHelp() const override { return "who knows"; }

 private:
  void check(std::span<const std::uint32_t>) const override {}
  void decode(std::span<const std::uint32_t>) override {}
  Format format_;
};

}  // namespace ortung::test
