#include "ortung/core/Extractor.hpp"

namespace ortung {

ExtractorError::~ExtractorError() = default;
Extractor::~Extractor() = default;

}  // namespace ortung
