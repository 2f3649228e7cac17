/// Lines, servers and child processes that devices hang on: bytes, ends, and what errors say.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "Await.hpp"
#include "Files.hpp"
#include "ortung/devices/ChildProcess.hpp"
#include "ortung/devices/Port.hpp"
#include "ortung/emulators/Endpoint.hpp"

namespace ortung {
namespace {

using std::chrono::milliseconds;
using test::comesTrue;
using test::messageOf;

constexpr milliseconds kPatience{5000};  // nothing here lasts as long

TEST(Port, NamesThatAreNoPortAreRefused) {
  const auto complaint = [](const std::string& name, int baud) {
    return messageOf<std::invalid_argument>([&] { Port::open(name, baud); });
  };
  EXPECT_EQ(complaint("", 9600), "port '': expected /dev/... or tcp:HOST:PORT");
  for (const std::string name : {"tcp:", "tcp:host", "tcp::80", "tcp:host:"})
    EXPECT_EQ(complaint(name, 9600), "port '" + name + "': expected tcp:HOST:PORT");
  EXPECT_EQ(complaint("/dev/null", 12345),
            "port '/dev/null': serial lines have no speed of 12345 baud");
}

TEST(Port, WhatIsNotThereOrNoLineIsAbsent) {
  const test::TemporaryFolder folder;
  const std::string gone = (folder / "gone").string();
  EXPECT_EQ(messageOf<DeviceAbsent>([&] { Port::open(gone, 9600); }),
            gone + ": No such file or directory");
  const std::string file = (folder / "file").string();
  test::writeBytes(file, "");
  EXPECT_TRUE(messageOf<DeviceAbsent>([&] {
                Port::open(file, 9600);
              }).starts_with(file + ": is not a serial line: "));
  EXPECT_TRUE(messageOf<DeviceAbsent>([&] {
                Port::open("tcp:127.0.0.1:http", 9600);
              }).starts_with("tcp:127.0.0.1:http: "))
      << "a port is a number";
}

TEST(Port, KnowsTheSpeedsOfSerialLines) {
  for (const int baud : {1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800,
                         500000, 921600, 1000000})
    EXPECT_TRUE(isLineSpeed(baud)) << baud;
  for (const int baud : {0, -9600, 300, 14400, 2000000}) EXPECT_FALSE(isLineSpeed(baud)) << baud;
}

/// Reads until there are so many bytes.
std::string readAll(Port& port, std::size_t count, std::size_t most = 4096) {
  std::string bytes;
  while (bytes.size() < count)
    if (!port.read(bytes, kPatience, most)) break;
  return bytes;
}

TEST(Port, ALineCarriesAllBytesBothWaysAtItsSpeed) {
  const test::TemporaryFolder folder;
  PseudoTerminal end(folder / "line");
  std::string all;  // those that terminals like to change, too
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  for (const int baud : {9600, 500000}) {
    const auto port = Port::open((folder / "line").string(), baud);
    EXPECT_EQ(end.baud(), baud);
    end.write(all);
    EXPECT_EQ(readAll(*port, all.size()), all);
    port->write(all);
    std::string back;
    while (back.size() < all.size()) end.read(back);
    EXPECT_EQ(back, all);
  }
}

TEST(Port, GivesNoMoreBytesAtATimeThanItMay) {
  const test::TemporaryFolder folder;
  PseudoTerminal end(folder / "line");
  const auto port = Port::open((folder / "line").string(), 9600);
  end.write("abcdef");
  std::string bytes = "before ";
  ASSERT_TRUE(port->read(bytes, kPatience, 1));
  EXPECT_EQ(bytes, "before a") << "it appends";
  EXPECT_EQ(readAll(*port, 5, 2), "bcdef");
  EXPECT_FALSE(port->read(bytes, milliseconds(0)));
  EXPECT_EQ(bytes, "before a");
}

TEST(Port, WhatCameBeforeItWasOpenedIsOutOfDate) {
  const test::TemporaryFolder folder;
  PseudoTerminal end(folder / "line");
  end.write("old");
  const auto port = Port::open((folder / "line").string(), 9600);
  end.write("new");
  EXPECT_EQ(readAll(*port, 3), "new");
}

TEST(Port, AnUnpluggedLineIsAbsent) {
  const test::TemporaryFolder folder;
  PseudoTerminal end(folder / "line");
  const std::string name = (folder / "line").string();
  EXPECT_EQ(end.name(), name);
  const auto port = Port::open(name, 9600);
  end.unplug();
  EXPECT_EQ(end.name(), "");
  EXPECT_FALSE(std::filesystem::is_symlink(name));
  std::string bytes;
  EXPECT_TRUE(
      messageOf<DeviceAbsent>([&] { port->read(bytes, kPatience); }).starts_with(name + ": "));
  EXPECT_EQ(bytes, "");
  end.plug();
  EXPECT_EQ(end.name(), name);
  EXPECT_NO_THROW(Port::open(name, 9600));
}

// Another program's link at the same place is left alone.
TEST(Port, AnEmulatorTakesAwayItsOwnLinkAlone) {
  const test::TemporaryFolder folder;
  std::filesystem::create_symlink("/nowhere", folder / "line");
  {
    PseudoTerminal end(folder / "line");
    EXPECT_NE(std::filesystem::read_symlink(folder / "line"), "/nowhere") << "it was replaced";
    std::filesystem::remove(folder / "line");
    std::filesystem::create_symlink("/elsewhere", folder / "line");
  }
  EXPECT_EQ(std::filesystem::read_symlink(folder / "line"), "/elsewhere");
}

TEST(Port, AServerCarriesBytesBothWaysUntilItCloses) {
  TcpEndpoint end(0);
  const std::string name = end.name();
  EXPECT_EQ(name, "tcp:127.0.0.1:" + std::to_string(end.port()));
  const auto port = Port::open(name, 0);
  EXPECT_EQ(port->name(), name);
  port->write("question");
  std::string question;
  while (question.size() < 8) end.read(question);
  EXPECT_EQ(question, "question");
  end.write("answer");
  EXPECT_EQ(readAll(*port, 6), "answer");
  end.unplug();
  std::string bytes;
  EXPECT_EQ(messageOf<DeviceAbsent>([&] { port->read(bytes, kPatience); }), name + ": was closed");
  EXPECT_TRUE(messageOf<DeviceAbsent>([&] { Port::open(name, 0); }).starts_with(name + ": "));
}

// A new client replaces the last one, which may have been forgotten somewhere.
TEST(Port, AServersNewClientReplacesTheLastOne) {
  TcpEndpoint end(0);
  const auto first = Port::open(end.name(), 0);
  std::string got;
  first->write("1");
  while (got.empty()) end.read(got);
  const auto second = Port::open(end.name(), 0);
  second->write("2");
  while (got.size() < 2) end.read(got);
  EXPECT_EQ(got, "12");
  std::string bytes;
  EXPECT_THROW(first->read(bytes, kPatience), DeviceAbsent);
  end.write("x");
  EXPECT_EQ(readAll(*second, 1), "x");
}

TEST(Port, AServerThatIsLeftTakesTheNextClient) {
  TcpEndpoint end(0);
  for (const char* const word : {"a", "b", "c"}) {
    const auto port = Port::open(end.name(), 0);
    port->write(word);
    std::string got;
    for (int i = 0; i < 1'000'000 && got.empty(); ++i) end.read(got);
    EXPECT_EQ(got, word);
    end.write(word);
    EXPECT_EQ(readAll(*port, 1), word);
  }
}

// As a line does: what its reader does not take is lost, and nobody waits for it.
TEST(Port, AnEndWritesWhatItsReaderTakes) {
  const test::TemporaryFolder folder;
  PseudoTerminal line(folder / "line");
  TcpEndpoint server(0);
  const std::pair<Endpoint*, std::string> all[] = {{&line, (folder / "line").string()},
                                                   {&server, server.name()}};
  for (const auto& [end, name] : all) {
    const auto port = Port::open(name, 9600);
    std::string got;
    port->write("1");
    for (int i = 0; i < 1'000'000 && got.empty(); ++i) end->read(got);
    constexpr std::size_t kMuch = 1u << 25;
    errno = 0;
    end->write(std::string(kMuch, 'x'));
    end->write(std::string(kMuch, 'y'));
    std::string bytes;
    while (port->read(bytes, milliseconds(0))) {
    }
    EXPECT_LT(bytes.size(), 2 * kMuch);
    EXPECT_EQ(bytes.find_first_not_of("xy"), bytes.npos);
    EXPECT_EQ(bytes.substr(0, 1), "x") << "in the order in which it was written";
    EXPECT_TRUE(std::is_sorted(bytes.begin(), bytes.end()));
    end->write("z");
    EXPECT_EQ(readAll(*port, 1), "z") << "there is room again";
  }
}

// A descriptor that was closed is somebody else's soon.
TEST(Port, AServerThatIsUnpluggedLeavesTheDescriptorsOfOthersAlone) {
  TcpEndpoint end(0);
  const auto port = Port::open(end.name(), 0);
  std::string got;
  port->write("1");
  for (int i = 0; i < 1'000'000 && got.empty(); ++i) end.read(got);
  end.unplug();
  int pair[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, pair), 0);
  end.write("x");
  end.read(got);
  end.unplug();
  EXPECT_EQ(got, "1");
  for (const int one : pair) {
    char letter = 0;
    EXPECT_EQ(::recv(one, &letter, 1, 0), -1);
    EXPECT_EQ(errno, EAGAIN) << "nothing was written, and it is still open";
  }
  for (const int one : pair) ::close(one);
}

/// Descriptor 0 is free while this lives, as in a program that was started without an input.
class WithoutInput {
 public:
  WithoutInput() { ::close(0); }
  ~WithoutInput() {
    if (kept_ < 0) return;
    ::dup2(kept_, 0);
    ::close(kept_);
  }
  WithoutInput(const WithoutInput&) = delete;
  WithoutInput& operator=(const WithoutInput&) = delete;

 private:
  int kept_ = ::dup(0);
};

TEST(Port, AnyEndMayHaveTheDescriptor0) {
  const test::TemporaryFolder folder;
  const auto answers = [](Endpoint& end, Port& port) {
    std::string question;
    port.write("question");
    for (int i = 0; i < 1'000'000 && question.size() < 8; ++i) end.read(question);
    EXPECT_EQ(question, "question");
    end.write("answer");
    EXPECT_EQ(readAll(port, 6), "answer");
  };
  {
    const WithoutInput zero;
    PseudoTerminal line(folder / "line");
    const auto port = Port::open((folder / "line").string(), 9600);
    answers(line, *port);
  }
  {
    const WithoutInput zero;
    TcpEndpoint server(0);
    const auto port = Port::open(server.name(), 0);
    answers(server, *port);
  }
  {
    TcpEndpoint server(0);
    const WithoutInput zero;
    const auto port = Port::open(server.name(), 0);
    answers(server, *port);
  }
  TcpEndpoint server(0);
  const auto port = Port::open(server.name(), 0);
  const WithoutInput zero;  // of the server's side of the connection
  answers(server, *port);
}

TEST(Port, AServersAddressIsOneOfNumbers) {
  EXPECT_EQ(messageOf<std::runtime_error>([] { TcpEndpoint(0, "localhost"); }),
            "localhost: expected an address such as 127.0.0.1");
}

/// A shell that runs a script.
struct Script {
  explicit Script(const std::string& text, std::size_t longest = 100)
      : child("/bin/sh", {"-c", text}, longest) {}
  /// Its next line, for which it has a lot of time.
  std::string next() {
    std::optional<std::string> line;
    EXPECT_TRUE(comesTrue("it writes a line", [&] {
      line = child.next(kPatience);
      return line.has_value();
    }));
    return line.value_or("");
  }
  ChildProcess child;
};

TEST(ChildProcess, GivesItsLinesAndSaysHowItEnded) {
  Script script("printf 'one\\ntwo\\r\\n'; exit 3");
  EXPECT_EQ(script.next(), "one");
  EXPECT_EQ(script.next(), "two");
  EXPECT_EQ(messageOf<DeviceAbsent>([&] { script.next(); }), "sh ended with status 3");
}

TEST(ChildProcess, NamesTheSignalThatEndedIt) {
  Script script("kill -TERM $$");
  EXPECT_EQ(messageOf<DeviceAbsent>([&] { script.next(); }),
            "sh was ended by signal 15 (Terminated)");
}

// It reads nothing and writes its errors nowhere; no other file of this program is open in it.
TEST(ChildProcess, InheritsNothing) {
  Script script("cat; echo error >&2; ls /proc/$$/fd | tr '\\n' ' '; echo", 1000);
  const std::string open = script.next();
  EXPECT_TRUE(open.starts_with("0 1 2 ")) << open;
  EXPECT_LE(open.size(), 10u) << "what ls itself may have opened: " << open;
}

TEST(ChildProcess, LinesThatAreTooLongAreDropped) {
  Script script("echo 12345678901; echo short; exec sleep 1000", 10);
  EXPECT_EQ(script.next(), "short");
  EXPECT_FALSE(script.child.next()) << "no more has come, and this does not wait";
}

TEST(ChildProcess, AProgramThatIsNotThereDoesNotStart) {
  EXPECT_EQ(messageOf<std::runtime_error>([] { ChildProcess("/nowhere/x", {}, 10); }),
            "/nowhere/x does not start: No such file or directory");
}

}  // namespace
}  // namespace ortung
