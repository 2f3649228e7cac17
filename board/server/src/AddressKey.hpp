#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <string>

namespace ortung::server {

/// By which the computers of clients are told apart: the address, of IPv6 the network.
std::string addressKey(const boost::asio::ip::tcp::socket& socket);

}  // namespace ortung::server
