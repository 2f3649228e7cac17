#include <gtest/gtest.h>

#include "HostCheck.hpp"

namespace ortung::web {
namespace {

TEST(HostCheck, AddressesAndLocalhostAreOurOwnAndStrangeNamesAreNot) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:7777", "localhost", "LocalHost:80", "[::1]:7777",
                           "192.168.1.20:7777", "[fe80::1]", "robot.lan:7777", "ROBOT.lan"})
    EXPECT_TRUE(isOwnHost(host, {"robot.lan"})) << host;
  for (const char* host :
       {"", "evil.example", "evil.example:7777", "localhost.evil.example", "127.0.0.1.evil.example",
        "[::1", "[::1]x", "[::1]:port", "127.0.0.1:77777777",
        "127.0.0.1:", "robot.lan.evil.example", ":7777", "[]"})
    EXPECT_FALSE(isOwnHost(host, {"robot.lan"})) << host;
}

TEST(HostCheck, PagesOfOurOwnConnectAndThoseOfOthersOnlyByName) {
  EXPECT_TRUE(isOwnOrigin("", "127.0.0.1:7777", {}));
  EXPECT_TRUE(isOwnOrigin("http://127.0.0.1:7777", "127.0.0.1:7777", {}));
  EXPECT_TRUE(isOwnOrigin("https://robot.lan", "robot.lan", {}));
  EXPECT_TRUE(isOwnOrigin("https://view.example", "127.0.0.1:7777", {"https://view.example"}));
  for (const char* origin :
       {"null", "http://127.0.0.1", "http://127.0.0.1:7778", "http://evil.example",
        "ftp://127.0.0.1:7777", "http://127.0.0.1:7777.evil.example", "file://"})
    EXPECT_FALSE(isOwnOrigin(origin, "127.0.0.1:7777", {"https://view.example"})) << origin;
}

}  // namespace
}  // namespace ortung::web
