#include "PublishedRecord.hpp"

#include "SourceArguments.hpp"

namespace ortung::app {

PublishedRecord::PublishedRecord(const std::filesystem::path& file, Localization& localization)
    : localization_(localization),
      record_(file, notesOf(localization.source(), localization.container())) {
  localization.wantSamples(true);
  localization.feeder().recordInto(record_);
}

PublishedRecord::~PublishedRecord() = default;

void PublishedRecord::writePublished() {
  const Timestamp now = localization_.feeder().stamp();
  const auto all = localization_.container().all();
  seen_.resize(all.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const SensorData& data = *all[i];
    if (data.id().model != "mcl" || data.sequence() == seen_[i]) continue;
    seen_[i] = data.sequence();
    const std::span<const std::uint32_t> words = data.getData();
    record_.write({now, data.id(), {words.begin(), words.end()}});
  }
  record_.endMoment();
}

}  // namespace ortung::app
