#pragma once

#include <cstdint>
#include <cstring>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>

namespace ortung::ros2 {

/// A message as it is on the wire.
struct Bytes {
  std::string cdr;
};

/// Messages for Fast DDS whose CDR somebody else makes and reads.
class BytesType : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  static constexpr std::size_t kMostBytes = std::size_t{1} << 27;  ///< a map has millions

  explicit BytesType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 1024;  // what a message has at first; it grows
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, Payload* payload) override {
    const std::string& cdr = static_cast<Bytes*>(data)->cdr;
    if (cdr.size() > payload->max_size) return false;
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(cdr.size());
    std::memcpy(payload->data, cdr.data(), cdr.size());
    return true;
  }
  bool deserialize(Payload* payload, void* data) override {
    if (payload->length > kMostBytes) return false;
    static_cast<Bytes*>(data)->cdr.assign(reinterpret_cast<const char*>(payload->data),
                                          payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const auto size = static_cast<std::uint32_t>(static_cast<Bytes*>(data)->cdr.size());
    return [size] { return size; };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace ortung::ros2
