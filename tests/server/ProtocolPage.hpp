#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "Files.hpp"
#include "Paths.hpp"
#include "ortung/server/BoardCommand.hpp"

namespace ortung::test {

/// A command as a table of docs/protocol.md has it; several rows of one are put together.
struct DocumentedCommand {
  std::string name;
  std::string role;  ///< the least; "" of what may be said before HELLO
  std::string text;  ///< all of its rows
};

/// The commands of the table in a section, in its order.
inline std::vector<DocumentedCommand> documentedCommands(const std::string& section) {
  std::istringstream page(readBytes(ORTUNG_SOURCE_DIR "/docs/protocol.md"));
  std::vector<DocumentedCommand> commands;
  const std::regex row(R"(\| (`[A-Z].*?`.*?) \| ((viewer|player|operator)?.*?) ?\| .*)");
  const std::regex name("`([A-Z]{2,})");
  bool isThere = false;
  for (std::string line; std::getline(page, line);) {
    std::smatch cells;
    if (line.starts_with("## ")) isThere = line == "## " + section;
    if (!isThere || !std::regex_match(line, cells, row)) continue;
    const std::string first = cells[1];
    for (std::sregex_iterator next(first.begin(), first.end(), name), end; next != end; ++next) {
      if (commands.empty() || commands.back().name != (*next)[1])
        commands.push_back({(*next)[1], cells[3], ""});
      commands.back().text += line;
    }
  }
  return commands;
}

/// The keys of the arguments that a help begins with: "robot=" of "[robot=N], what is new".
inline std::set<std::string> keysOf(const std::string& help) {
  const std::string arguments = help.substr(0, help.find(", "));
  std::set<std::string> keys;
  const std::regex key("([a-z_]+=)");
  for (std::sregex_iterator next(arguments.begin(), arguments.end(), key), end; next != end; ++next)
    keys.insert((*next)[1]);
  return keys;
}

/// Whether what a command's help names stands in its rows; "..." there is what others have, too.
inline void expectDocumented(const DocumentedCommand& documented, const std::string& help) {
  for (const std::string& key : keysOf(help))
    EXPECT_TRUE(documented.text.find(key) != std::string::npos ||
                documented.text.find("...`") != std::string::npos)
        << documented.name << " takes " << key << ", of which docs/protocol.md does not tell";
}

/// Whether a section's table has the commands that a host adds, no other, and with their roles.
inline void expectDocumented(const std::string& section,
                             const std::vector<BoardCommand>& commands) {
  const char* const roles[] = {"viewer", "player", "operator"};
  const std::vector<DocumentedCommand> documented = documentedCommands(section);
  ASSERT_EQ(documented.size(), commands.size());
  for (std::size_t i = 0; i < commands.size(); ++i) {
    EXPECT_EQ(documented[i].name, commands[i].name);
    EXPECT_EQ(documented[i].role, roles[static_cast<std::size_t>(commands[i].least)]);
    expectDocumented(documented[i], commands[i].help);
  }
}

}  // namespace ortung::test
