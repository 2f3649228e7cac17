// What is made of the protocol's commands: its page and the words that the fuzzer tries.
#include <gtest/gtest.h>

#include <cstdlib>

#include "Command.hpp"
#include "Paths.hpp"
#include "ProtocolPage.hpp"

namespace ortung::test {
namespace {

using server::Command;
using server::CommandTable;

TEST(CommandTable, IsTheTableOfThePage) {
  const CommandTable table;
  const std::vector<DocumentedCommand> documented = documentedCommands("Commands");
  ASSERT_EQ(documented.size(), table.all().size());
  for (std::size_t i = 0; i < documented.size(); ++i) {
    const Command& command = table.all()[i];
    EXPECT_EQ(documented[i].name, command.name);
    EXPECT_EQ(documented[i].role, command.least ? server::nameOf(*command.least) : "")
        << command.name;
    expectDocumented(documented[i], command.help);
  }
}

TEST(CommandTable, FindsEachCommandByItsName) {
  const std::vector<BoardCommand> added = {{.name = "ECHO", .help = "", .handle = {}}};
  const CommandTable table(added);
  for (const Command& command : table.all()) EXPECT_EQ(table.find(command.name), &command);
  EXPECT_EQ(table.all().back().name, "ECHO");
  EXPECT_EQ(table.find("FLY"), nullptr);
  EXPECT_EQ(CommandTable().find("ECHO"), nullptr);
}

/// Words in their order, each once.
class Dictionary {
 public:
  void add(const std::string& word) {
    if (known_.insert(word).second) text_ += "\"" + word + "\"\n";
  }
  /// The keys of a help, and what it offers as a choice: "on|off", "form=binary".
  void addHelp(const std::string& help) {
    const std::regex token(R"([^\s\[\],:]+)");
    for (std::sregex_iterator next(help.begin(), help.end(), token), end; next != end; ++next)
      addToken(next->str());
  }
  const std::string& text() const { return text_; }

 private:
  void addToken(const std::string& token) {
    const bool isChoice = token.find('|') != std::string::npos;
    std::istringstream parts(token);
    std::string key;
    for (std::string part; std::getline(parts, part, '|');) {
      if (const std::size_t end = part.find('='); end != std::string::npos) {
        key = part.substr(0, end + 1);
        part.erase(0, end + 1);
        add(key);
      }
      const bool isWord = std::regex_match(part, std::regex("[a-z]{2,}"));
      if (isWord && (isChoice || !key.empty())) add(key + part);
    }
  }
  std::string text_;
  std::set<std::string> known_;
};

/// What no help names: of other texts, of the target itself, and of its inputs' form.
const char* const kOtherWords[] = {
    "ortung/1",
    "theta_rad=",
    "team=",
    "kicker",
    "*/*/*",
    "camera/*/*",
    R"([[sensor]]\x0aplugin = \"odometry\"\x0a.\x0a)",
    "GET / HTTP/1.1",
    "ECHO",
    "MULL",
    "#1 ",
    R"(\x0a)",
    R"(\xfe)",
    R"(\xff)",
};

/// Where commands have changed: remove the file, and run this with ORTUNG_NEW_GOLDEN=1.
TEST(CommandTable, GivesTheFuzzerItsWords) {
  Dictionary dictionary;
  const CommandTable table;
  for (const Command& command : table.all()) {
    dictionary.add(command.name);
    dictionary.addHelp(command.help);
  }
  for (const char* word : kOtherWords) dictionary.add(word);
  const std::filesystem::path file = ORTUNG_SOURCE_DIR "/tests/fuzz/protocol.dict";
  if (!std::filesystem::exists(file) && std::getenv("ORTUNG_NEW_GOLDEN") != nullptr)
    writeBytes(file, dictionary.text());
  EXPECT_EQ(readBytes(file), dictionary.text());
}

}  // namespace
}  // namespace ortung::test
