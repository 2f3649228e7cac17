#include <memory>

#include "ortung/mcl_player/SelfLocalization.hpp"
#include "ortung/sim_api/Player.hpp"

using namespace ortung;

class LocalizedPlayer : public Player {
 public:
  explicit LocalizedPlayer(const Pose2& told) : told(told) {}
  // the block
  return here.has_value();
}

private : Pose2 told;
std::unique_ptr<SelfLocalization> self_;
}
;
