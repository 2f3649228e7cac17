#include "ortung/core/SourceHelp.hpp"

#include <utility>

namespace ortung {

SourceHelp::SourceHelp(std::string path, std::vector<SourceOption> options)
    : path_(std::move(path)), options_(std::move(options)) {}

SourceHelp::~SourceHelp() = default;

}  // namespace ortung
