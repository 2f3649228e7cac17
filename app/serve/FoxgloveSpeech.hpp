#pragma once

#include "ortung/web/WebSpeech.hpp"

namespace ortung::app {

/// What Foxglove, Lichtblick and their like speak, at any path: foxglove.sdk.v1 and, of older ones,
/// foxglove.websocket.v1. A query token=T is the client's token for the board.
WebProtocol foxgloveProtocol();

}  // namespace ortung::app
