#include "ortung/run/FoundChanges.hpp"

#include <array>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "BeliefFile.hpp"
#include "ortung/mcl/MapChanges.hpp"
#include "ortung/records/RecordSource.hpp"
#include "ortung/run/Published.hpp"
#include "ortung/tables/TableFile.hpp"

namespace ortung {
namespace {

bool beginsLikeARecord(const std::filesystem::path& file) {
  std::array<char, 32> begin{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(begin.data(), begin.size());
  return isRecord(std::string_view(begin.data(), static_cast<std::size_t>(stream.gcount())));
}

FoundChanges newestIn(const std::filesystem::path& file) {
  RecordSource record(file);
  ChangesData data;
  bool has = false;
  for (Message message; record.next(message);) {
    if (message.id != data.id()) continue;
    try {
      data.setData(message.stamp, message.words);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(file.string() + ": " + toText(message.id) + ": " + error.what());
    }
    has = true;
  }
  if (!has)
    throw std::runtime_error(file.string() + ": has no reading of " + toText(data.id()) +
                             ", expected a record of a localization");
  return {data.reading(), record.worldFingerprint()};
}

}  // namespace

FoundChanges readFoundChanges(const std::filesystem::path& path) {
  if (beginsLikeARecord(path)) return newestIn(path);
  const TableFile file(path);
  return {toldOf(changesIn(file)), worldIn(file)};
}

}  // namespace ortung
