#include "AddressKey.hpp"

#include <algorithm>

namespace ortung::server {

std::string addressKey(const boost::asio::ip::tcp::socket& socket) {
  boost::system::error_code error;
  auto address = socket.remote_endpoint(error).address();
  if (error) return "an unknown address";
  if (!address.is_v6()) return address.to_string();
  const boost::asio::ip::address_v6 v6 = address.to_v6();
  if (v6.is_v4_mapped()) return make_address_v4(boost::asio::ip::v4_mapped, v6).to_string();
  // A computer may have any number of addresses in its /64 network, so these count as one.
  auto bytes = v6.to_bytes();
  std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
  return v6.is_loopback() ? v6.to_string() : boost::asio::ip::address_v6(bytes).to_string() + "/64";
}

}  // namespace ortung::server
