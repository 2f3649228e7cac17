#include <iostream>
#include <memory>
#include <string>

#include "ortung/refbox/RefBoxClient.hpp"
#include "ortung/sim_api/Referee.hpp"

using namespace ortung;
namespace {
refbox::WorldState stateOfTeam() { return {}; }
double seconds() { return 0.0; }
}  // namespace

void play(const std::unique_ptr<Referee>& referee, const bool& running);
void play(const std::unique_ptr<Referee>& referee, const bool& running) {
  // the block
}
