#include "BenchField.hpp"
#include "HotCall.hpp"
#include "ortung/core/ReadingLine.hpp"
#include "ortung/formats/ScanData.hpp"

namespace ortung::instructions {

/// What board, clients and records do with each reading: write its line, and read it.
void addTalk(HotCalls& calls) {
  Message message{1'000'000, {"LMS200", "LRF", "scan"}, {}};
  ScanData::encode(bench::scanAt(bench::kRobot), bench::kMaxRange, message.words);
  calls.push_back({"reading_lines", [=] {
                     std::string line;
                     for (int i = 0; i < 100; ++i) {
                       line.clear();
                       writeLine(message, line);
                       parseLine(line);
                     }
                   }});
}

}  // namespace ortung::instructions
