#include <gtest/gtest.h>

#include "HostPort.hpp"

namespace ortung::app {
namespace {

void expectParts(const std::string& text, const std::string& host,
                 std::optional<std::uint16_t> port) {
  const auto found = parseHostPort(text);
  ASSERT_TRUE(found) << text;
  EXPECT_EQ(found->host, host) << text;
  EXPECT_EQ(found->port, port) << text;
}

TEST(HostPort, PortIsBehindTheLastColonAndMayBeLeftOut) {
  expectParts("127.0.0.1:7777", "127.0.0.1", 7777);
  expectParts("localhost", "localhost", std::nullopt);
  expectParts("host:0", "host", 0);
  expectParts("host:65535", "host", 65535);
  expectParts(":80", "", 80);
}

// RFC 3986, section 3.2.2: an address with colons stands in brackets, which are not part of it.
TEST(HostPort, AddressesWithColonsStandInBrackets) {
  expectParts("[::1]:7777", "::1", 7777);
  expectParts("[fe80::2]", "fe80::2", std::nullopt);
  expectParts("[::]", "::", std::nullopt);
  expectParts("[open:7", "[open", 7);
}

TEST(HostPort, WhatIsNoPortIsRefused) {
  for (const char* text : {"host:", "host:65536", "host:-1", "host:8x", "host: 8", "host:0x10",
                           "host:1.5", "[::1]:", "[::1]:x"})
    EXPECT_FALSE(parseHostPort(text)) << text;
}

// 0.0.0.0 and :: are all addresses of a computer, none that one could go to.
TEST(HostPort, BrowsersReachServersOnAllAddressesAtLocalhost) {
  EXPECT_EQ(hostForBrowsers("0.0.0.0"), "localhost");
  EXPECT_EQ(hostForBrowsers("::"), "localhost");
  EXPECT_EQ(hostForBrowsers("127.0.0.1"), "127.0.0.1");
  EXPECT_EQ(hostForBrowsers("192.168.0.7"), "192.168.0.7");
  EXPECT_EQ(hostForBrowsers("::1"), "[::1]");
}

}  // namespace
}  // namespace ortung::app
