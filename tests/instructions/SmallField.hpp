#pragma once

#include <memory>

#include "BenchField.hpp"

/// A part of the benchmarks' field around their robot, which is learned soon even where every
/// instruction is counted.
namespace ortung::instructions {

const FieldRegion& smallRegion();
/// The scanner that has learned it, one for all calls.
std::shared_ptr<ScanData> scannerWith(ScanData::Perception perception);
/// Samples all over it, in all headings.
SampleSet samplesOnIt(std::size_t n);

}  // namespace ortung::instructions
