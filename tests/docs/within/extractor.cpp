#include "ortung/core/Extractor.hpp"

using namespace ortung;

class NameExtractor : public Extractor {
 public:
  // the block
};
