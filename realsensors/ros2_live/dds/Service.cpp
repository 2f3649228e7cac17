#include "Service.hpp"

#include <fastdds/rtps/common/WriteParams.h>

#include <chrono>
#include <exception>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

namespace ortung::ros2 {
namespace {

/// How long an answer waits for its reader to be known [s]: discovery of a request and of who waits
/// for its answer go their own ways.
constexpr std::chrono::seconds kPatience{1};

}  // namespace

void Participant::Service::open(const std::string& name, std::string_view type) {
  const std::string plain(type);
  answers_ =
      parts_.writer("rr" + name + "Reply", ddsType(plain + "_Response"), "", Qos::kDefault, this);
  dds::DataReader* const requests =
      parts_.reader("rq" + name + "Request", ddsType(plain + "_Request"), "", Qos::kDefault, this);
  parts_.writers.push_back(answers_);
  parts_.writerIds.push_back(answers_->guid());
  parts_.readers.push_back(requests);
  parts_.readerIds.push_back(requests->guid());
}

void Participant::Service::close() {
  const std::lock_guard lock(mutex_);
  isClosed_ = true;
  changed_.notify_all();
}

void Participant::Service::on_data_available(dds::DataReader* reader) {
  dds::SampleInfo info;
  while (reader->take_next_sample(&bytes_, &info) == ReturnCode_t::RETCODE_OK) {
    if (!info.valid_data) continue;
    Asked asked = info.sample_identity;
    if (info.related_sample_identity.writer_guid() != GUID_t::unknown())
      asked.writer_guid() = info.related_sample_identity.writer_guid();
    if (!parts_.desk.take([this, request = bytes_.cdr, asked] { answer(request, asked); }))
      ++parts_.dropped;
  }
}

void Participant::Service::on_publication_matched(dds::DataWriter*,
                                                  const dds::PublicationMatchedStatus& status) {
  const GUID_t reader = eprosima::fastrtps::rtps::iHandle2GUID(status.last_subscription_handle);
  const std::lock_guard lock(mutex_);
  if (status.current_count_change > 0)
    waiting_.insert(reader);
  else
    waiting_.erase(reader);
  changed_.notify_all();
}

bool Participant::Service::waitFor(const GUID_t& reader) {
  // Some clients tell the writer of their request, which nobody can wait for.
  constexpr std::uint8_t kKindOfReaders = 0x04;
  if ((reader.entityId.value[3] & kKindOfReaders) == 0) return true;
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kPatience, [&] { return isClosed_ || waiting_.contains(reader); });
  return !isClosed_;
}

void Participant::Service::answer(const std::string& request, const Asked& asked) {
  Bytes bytes;
  try {
    bytes.cdr = handler_(request);
  } catch (const std::exception&) {
    ++parts_.refused;
    return;
  }
  if (!waitFor(asked.writer_guid())) return;
  eprosima::fastrtps::rtps::WriteParams which;
  which.related_sample_identity(asked);
  if (!answers_->write(&bytes, which)) ++parts_.dropped;
}

}  // namespace ortung::ros2
