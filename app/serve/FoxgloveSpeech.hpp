#pragma once

#include "ortung/web/WebSpeech.hpp"

namespace ortung::app {

/// Returns the protocol of Foxglove, Lichtblick and similar viewers, at any path: foxglove.sdk.v1
/// and, for older viewers, foxglove.websocket.v1. A query token=T is the client's token for the
/// board.
WebProtocol foxgloveProtocol();

}  // namespace ortung::app
