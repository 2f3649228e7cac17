#include "ortung/sim_api/Player.hpp"

#include <utility>

#include "ortung/sim_api/Referee.hpp"

namespace ortung {

FloorPlan::~FloorPlan() = default;
Stage::~Stage() = default;
PlayerSeat::~PlayerSeat() = default;
Player::~Player() = default;

const Taught& PlayerSeat::taught() const {
  static const Taught kNothing;
  return kNothing;
}

PlayerHelp::PlayerHelp(std::string what, std::vector<PlayerOption> options)
    : what_(std::move(what)), options_(std::move(options)) {}
PlayerHelp::~PlayerHelp() = default;

}  // namespace ortung
