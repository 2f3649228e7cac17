// A client of Foxglove's protocol: the input's lines are its messages, those that begin with a
// control character in binary form.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "ortung/foxglove/FoxgloveSession.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(bytes), size);
  ortung::FoxgloveSession session;
  session.fromBoard(
      "OK HELLO client=1 role=viewer now=0\nOK DESCRIBE lines=1\nworld=run kind=record start_us=0 "
      "end_us=9000000 x_min_m=-2 y_min_m=-1 x_max_m=2 y_max_m=1\nOK DESCRIBE lines=1\n"
      "wall x0_m=-1 y0_m=1 x1_m=1 y1_m=1 z0_m=0 z1_m=1\nOK SUBSCRIBE robot=0\n"
      "OK LIST lines=1\nrobot=1 name=a client=0\nOK DESCRIBE lines=1\nsome/thing/else [words]\n");
  session.toBoard.clear();
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    session.fromClient(line, !line.empty() && static_cast<unsigned char>(line[0]) < ' ');
    // Whatever the client says, the board gets whole lines of printable characters.
    for (const char c : session.toBoard)
      if (c != '\n' && (c < ' ' || c > '~')) std::abort();
    if (!session.toBoard.empty() && session.toBoard.back() != '\n') std::abort();
    session.toBoard.clear();
  }
  session.fromBoard({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
