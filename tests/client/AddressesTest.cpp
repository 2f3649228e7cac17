// A computer with several addresses, the first of which this system can't use.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <netdb.h>
#include <sys/socket.h>

#include <string_view>

#include "ScriptedServer.hpp"
#include "ortung/client/RobotSession.hpp"

namespace ortung::test {
namespace {

constexpr std::string_view kHost = "two-addresses.test";

/// As ::1 is where the system has no IPv6: there are no sockets of this family.
addrinfo& unusable() {
  static addrinfo address = [] {
    addrinfo a{};
    a.ai_family = AF_UNSPEC;
    a.ai_socktype = SOCK_STREAM;
    return a;
  }();
  return address;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace
}  // namespace ortung::test

// In place of those of the C library, for this one host.
extern "C" __attribute__((visibility("default"))) int getaddrinfo(const char* host,
                                                                  const char* port,
                                                                  const addrinfo* hints,
                                                                  addrinfo** list) {
  using namespace ortung::test;
  const bool isOurs = host != nullptr && kHost == host;
  const auto real = next<decltype(getaddrinfo)>("getaddrinfo");
  if (!isOurs) return real(host, port, hints, list);
  const int error = real("127.0.0.1", port, hints, &unusable().ai_next);
  *list = &unusable();
  return error;
}

extern "C" __attribute__((visibility("default"))) void freeaddrinfo(addrinfo* list) noexcept {
  using namespace ortung::test;
  next<decltype(freeaddrinfo)>("freeaddrinfo")(list == &unusable() ? list->ai_next : list);
}

namespace ortung::test {
namespace {

TEST(Addresses, AreTriedUntilOneCanBeUsed) {
  ScriptedServer server([](const std::string&) { return ""; });
  SessionOptions options;
  options.host = kHost;
  options.port = server.port();
  options.name = "a";
  EXPECT_NO_THROW(RobotSession(options, "[robot]\n"));
}

TEST(Addresses, WithoutOneThatAnswersSayWhyTheLastOneDoesNot) {
  SessionOptions options;
  options.host = kHost;
  options.port = 1;
  options.name = "a";
  try {
    const RobotSession session(options, "[robot]\n");
    FAIL() << "there is a server at port 1";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "two-addresses.test:1: can't connect: Connection refused");
  }
}

}  // namespace
}  // namespace ortung::test
