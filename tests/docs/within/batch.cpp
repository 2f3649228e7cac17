#include "ortung/learning/Batch.hpp"

#include <string>
#include <vector>

int main() {
  // the block
}
