// How programs end: signals, and data that is saved before a hanging plugin ends them.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "Console.hpp"
#include "Files.hpp"
#include "Interrupt.hpp"
#include "Rescue.hpp"
#include "SourceArguments.hpp"

namespace ortung::app {
namespace {

/// Ends the process with 0 if all is as expected, with the place's number if not.
#define EXPECT_OR_EXIT(number, condition) \
  if (!(condition)) std::_Exit(number)

TEST(Interrupt, SignalsAreNotedAndThenEndWorkAsInterrupted) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EXIT(
        {
          for (const int one : {SIGINT, SIGTERM, SIGHUP}) std::signal(one, SIG_DFL);
          catchInterrupts();
          EXPECT_OR_EXIT(1, interruptSignal() == 0);
          checkInterrupt();
          std::raise(signal);
          EXPECT_OR_EXIT(2, interruptSignal() == signal);
          try {
            checkInterrupt();
          } catch (const Interrupted&) {
            std::_Exit(0);
          }
          std::_Exit(3);
        },
        testing::ExitedWithCode(0), "");
  }
}

TEST(Interrupt, ASecondSignalEndsTheProgramAtOnce) {
  EXPECT_EXIT(
      {
        std::signal(SIGTERM, SIG_DFL);
        catchInterrupts();
        std::raise(SIGTERM);
        std::raise(SIGTERM);
        std::_Exit(0);
      },
      testing::KilledBySignal(SIGTERM), "");
}

// nohup, and a shell's background jobs.
TEST(Interrupt, SignalsThatAreToBeIgnoredStayIgnored) {
  EXPECT_EXIT(
      {
        std::signal(SIGHUP, SIG_IGN);
        std::signal(SIGINT, SIG_DFL);
        catchInterrupts();
        std::raise(SIGHUP);
        EXPECT_OR_EXIT(1, interruptSignal() == 0);
        std::raise(SIGINT);
        EXPECT_OR_EXIT(2, interruptSignal() == SIGINT);
        std::_Exit(0);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Interrupt, WritingWithoutAReaderOrBeyondAFilesLimitIsAnErrorTimeAndAgain) {
  const test::TemporaryFolder folder;
  EXPECT_EXIT(
      {
        catchInterrupts();
        int ends[2];
        EXPECT_OR_EXIT(1, ::pipe(ends) == 0);
        ::close(ends[0]);
        for (int i = 0; i < 2; ++i) {
          errno = 0;
          EXPECT_OR_EXIT(2, ::write(ends[1], "x", 1) < 0 && errno == EPIPE);
        }
        const int file = ::open((folder / "f").c_str(), O_CREAT | O_WRONLY, 0600);
        rlimit small = {};
        small.rlim_cur = small.rlim_max = 1;
        ::setrlimit(RLIMIT_FSIZE, &small);
        EXPECT_OR_EXIT(3, ::write(file, "x", 1) == 1);
        for (int i = 0; i < 2; ++i) {
          errno = 0;
          EXPECT_OR_EXIT(4, ::write(file, "x", 1) < 0 && errno == EFBIG);
        }
        EXPECT_OR_EXIT(5, interruptSignal() == 0);
        std::_Exit(0);
      },
      testing::ExitedWithCode(0), "");
}

/// A source with nothing to read.
class Silence : public Source {
 public:
  explicit Silence(bool isLive) : isLive_(isLive) {}
  ~Silence() override = default;
  bool next(Message&) override { return false; }
  bool isLive() const override { return isLive_; }

 private:
  bool isLive_;
};

TEST(Interrupt, EndsALiveSourceLikeItsOwnEndAndAnyOtherByThrowing) {
  EXPECT_TRUE(unlessInterrupted(Silence(true), [] { return true; }));
  EXPECT_FALSE(unlessInterrupted(Silence(false), [] { return false; }));
  EXPECT_THROW(unlessInterrupted(Silence(true), []() -> bool { throw std::logic_error("torn"); }),
               std::logic_error);
  EXPECT_EXIT(
      {
        std::signal(SIGINT, SIG_DFL);
        catchInterrupts();
        // It comes while the source waits, which it says by an error of its own.
        const bool goesOn = unlessInterrupted(Silence(true), []() -> bool {
          std::raise(SIGINT);
          throw std::runtime_error("the wait was interrupted");
        });
        EXPECT_OR_EXIT(1, !goesOn);
        bool isAsked = false;
        EXPECT_OR_EXIT(2, !unlessInterrupted(Silence(true), [&] { return isAsked = true; }));
        EXPECT_OR_EXIT(3, !isAsked);
        try {
          unlessInterrupted(Silence(false), [&] { return isAsked = true; });
        } catch (const Interrupted&) {
          std::_Exit(isAsked ? 4 : 0);
        }
        std::_Exit(5);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Rescue, SavesAllSaysWhyAndEndsTheProgramThoughOneOfThemFails) {
  const test::TemporaryFolder folder;
  EXPECT_EXIT(
      {
        setCommandName("ortung sim");
        const Rescue first([&] { test::writeBytes(folder / "first", "saved"); });
        const Rescue full([] { throw std::runtime_error("no room on\nthe disk"); });
        const Rescue last([&] { test::writeBytes(folder / "last", "saved"); });
        {
          const Rescue gone([&] { test::writeBytes(folder / "gone", "saved"); });
        }
        Rescue::saveAllAndEnd("the plugin hangs", 7);
      },
      testing::ExitedWithCode(7),
      "ortung sim: the plugin hangs\nortung sim: no room on.x0athe disk");
  EXPECT_EQ(test::readBytes(folder / "first"), "saved");
  EXPECT_EQ(test::readBytes(folder / "last"), "saved");
  EXPECT_EQ(folder.files(), 2u);
}

}  // namespace
}  // namespace ortung::app
