#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "LineSpeed.hpp"
#include "ortung/emulators/Endpoint.hpp"

namespace ortung {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::generic_category().message(errno));
}

}  // namespace

Endpoint::~Endpoint() = default;

PseudoTerminal::PseudoTerminal(std::filesystem::path link) : link_(std::move(link)) { plug(); }

PseudoTerminal::~PseudoTerminal() { unplug(); }

std::string PseudoTerminal::name() const {
  if (master_ < 0) return "";
  return link_.empty() ? path_ : link_.string();
}

void PseudoTerminal::plug() {
  if (master_ >= 0) return;
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (master_ < 0) fail("no pseudo-terminal");
  char path[128];
  if (::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
      ::ptsname_r(master_, path, sizeof(path)) != 0)
    fail("pseudo-terminal");
  path_ = path;
  slave_ = ::open(path, O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (slave_ < 0) fail(path_);
  termios settings{};
  if (::tcgetattr(slave_, &settings) != 0) fail(path_);
  ::cfmakeraw(&settings);  // otherwise it would echo the device's bytes
  ::tcsetattr(slave_, TCSANOW, &settings);
  if (!link_.empty()) makeLink();
}

void PseudoTerminal::makeLink() {
  std::error_code error;
  if (std::filesystem::is_symlink(link_, error)) std::filesystem::remove(link_, error);
  std::filesystem::create_symlink(path_, link_, error);
  if (error) throw std::runtime_error(link_.string() + ": can't be made: " + error.message());
}

void PseudoTerminal::unplug() {
  if (master_ < 0) return;
  std::error_code error;
  if (!link_.empty() && std::filesystem::read_symlink(link_, error) == path_)
    std::filesystem::remove(link_, error);
  ::close(slave_);
  ::close(master_);
  master_ = slave_ = -1;
}

void PseudoTerminal::read(std::string& bytes) {
  char block[4096];
  while (master_ >= 0) {
    const ssize_t count = ::read(master_, block, sizeof(block));
    if (count <= 0) return;
    bytes.append(block, static_cast<std::size_t>(count));
  }
}

void PseudoTerminal::write(std::string_view bytes) {
  while (master_ >= 0 && !bytes.empty()) {
    const ssize_t count = ::write(master_, bytes.data(), bytes.size());
    if (count <= 0) return;  // full: the driver does not read
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

std::optional<int> PseudoTerminal::baud() const {
  termios settings{};
  if (slave_ < 0 || ::tcgetattr(slave_, &settings) != 0) return std::nullopt;
  const speed_t code = ::cfgetospeed(&settings);
  for (const LineSpeed& speed : kLineSpeeds)
    if (speed.code == code) return speed.baud;
  return 0;
}

}  // namespace ortung
