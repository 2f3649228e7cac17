// Says again what it hears, and who said it.
#include "ortung/core/Plugin.hpp"
#include "ortung/sim_api/Player.hpp"

namespace {
using namespace ortung;

class Parrot : public Player {
 public:
  explicit Parrot(const Parameters&) {}
  bool senseAndAct(PlayerSeat& seat) override {
    for (const Heard& heard : seat.heard()) seat.say(heard.from + " says " + heard.text);
    return true;
  }
};

}  // namespace

ORTUNG_PLUGINS("parrot", ortung::provide<ortung::Player, Parrot>("parrot"));
