// Options that exclude or need each other, and values of a form of their own.
#include "Workspace.hpp"

namespace ortung::test {
namespace {

using Words = std::vector<std::string>;

class OptionCombinations : public Workspace {
 protected:
  /// Expects wrong usage, which is said before anything is written.
  void expectWrong(const Words& command, const std::string& more) const {
    const Words before = files();
    const bool isGroup = command[0] == "export";
    const std::string name = "ortung " + command[0] + (isGroup ? " " + command[1] : "");
    expectRefused(ortung(command), 2, name + ": ", {more});
    EXPECT_EQ(files(), before);
  }
  Words eval(const Words& more) const {
    Words command = {
        "eval",     "--source",         "record:" + path("run.rec"), "--robot", path("robot.toml"),
        "--tables", path("hall.ortung")};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  Words sim(const Words& more) const {
    Words command = {"sim", path("hall.toml"), "--robot", path("robot.toml")};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
};

TEST_F(OptionCombinations, OfStartsAndConvergence) {
  expectWrong(eval({"--start-sigma=-0.1,5"}), "--start-sigma is '-0.1,5', expected numbers >= 0");
  expectWrong(eval({"--start-sigma=0.1,-5"}), "expected numbers >= 0");
  expectWrong(eval({"--start-sigma", "1"}), "expected 2 numbers \"m,deg\"");
  expectWrong(eval({"--start", "1,2"}), "--start is '1,2', expected 3 numbers \"x,y,theta_deg\"");
  expectWrong(eval({"--start", "home"}), "--start is 'home', expected 3 numbers");
  expectWrong(eval({"--converged-within", "0,5"}),
              "--converged-within is '0,5', expected numbers above 0");
  expectWrong(eval({"--converged-within=0.5,-1"}), "expected numbers above 0");
}

TEST_F(OptionCombinations, OfMotions) {
  learnTables();
  recordRun();
  expectWrong(eval({"--motion", "1,2,3"}),
              "--motion is '1,2,3', expected 4 numbers "
              "\"turn_per_turn,turn_per_m,way_per_m,way_per_turn\"");
  expectWrong(eval({"--motion=-1,1,1,1"}), "--motion: turn_per_turn");
}

TEST_F(OptionCombinations, OfCasesAndTheViewer) {
  const std::string view = "--view shows one run of one source as it is";
  expectWrong(eval({"--view", "--runs", "2"}), view);
  expectWrong(eval({"--view", "--fault", "odometry=missing"}), view);
  expectWrong(eval({"--view", "--kidnap", "1"}), view);
  expectWrong(eval({"--view", "--wake-ups", "1"}), view);
  expectWrong(eval({"--view", "--teleport", "0.1"}), view);
  expectWrong(eval({"--wake-ups", "1", "--teleport", "0.1"}), "leave out --runs and --teleport");
  expectWrong(eval({"--teleport", "0.1", "--start", "1,2,3"}),
              "--start is '1,2,3', but kidnaps and teleports begin at the truth");
  expectWrong(eval({"--filter", "grid", "--against-grid"}), "--filter is grid");
}

TEST_F(OptionCombinations, OfASimulationWithAndWithoutClients) {
  const std::string paceAndDoor = "--lockstep, --allow-control and --token-file are for --listen";
  expectWrong(sim({"--lockstep"}), paceAndDoor);
  expectWrong(sim({"--allow-control", "all"}), paceAndDoor);
  expectWrong(sim({"--token-file", path("tokens")}), paceAndDoor);
  expectWrong(sim({"--tables", path("hall.ortung")}), "--localize and --tables are for --listen");
  expectWrong(sim({"--record-into", path("records")}), "--record-into is for --listen and --view");
  expectWrong(sim({"--free-run", "--speed", "2"}), "--free-run and --speed exclude each other");
  const std::string clients = "--record, --duration and --digest do not fit --listen";
  expectWrong(sim({"--listen", "0", "--duration", "1"}), clients);
  expectWrong(sim({"--listen", "0", "--record", path("run.rec")}), clients);
  for (const char* door : {"[::1]", "127.0.0.1:", "localhost:x", "99999"})
    expectWrong(sim({"--listen", door}),
                std::string("--listen is '") + door + "', expected [ADDRESS:]PORT");
  expectWrong(sim({"--record", path("run.rec"), "--recorded", "bert"}),
              "--record: there is no robot 'bert' to record");
}

TEST_F(OptionCombinations, OfServersOfARecord) {
  recordRun();
  expectWrong({"serve", path("run.rec")}, "--listen [ADDRESS:]PORT or --view is missing");
  expectWrong({"view", path("none.rec")}, path("none.rec") + ": is neither a file nor a source");
}

TEST_F(OptionCombinations, OfPlayersOfAServer) {
  for (const char* server : {":7777", "host", "host:0", "host:x", "host:70000"})
    expectWrong({"play", "wander", "--server", server},
                std::string("--server is '") + server + "', expected HOST:PORT");
}

TEST_F(OptionCombinations, OfHiddenLayers) {
  for (const char* hidden : {"257", "1.5", "0", "8,8,8,8,8,8,8"})
    expectWrong({"train-motion", path("run.rec"), "--robot", path("robot.toml"), "--out",
                 path("net.json"), "--hidden", hidden},
                std::string("--hidden is '") + hidden + "', expected up to 6 widths from 1 to 256");
}

TEST_F(OptionCombinations, OfAreasAndPictures) {
  expectWrong({"learn", "--world", path("hall.toml"), "--robot", path("robot.toml"), "--out",
               path("t.ortung"), "--area", "1"},
              "--area is '1', expected 2 numbers \"x,y\"");
  expectWrong({"show", path("hall.ortung"), "--robot", path("robot.toml"), "--feature", "*/LRF/*",
               "--out", path("heat.png"), "--record", path("run.rec"), "--source", "record:x"},
              "--record and --source exclude each other");
  for (const Words& drawn :
       {Words{"--seed", "1"}, Words{"--variation", "0.5"}, Words{"--anywhere"}}) {
    Words command = {"export", "images", "record:" + path("run.rec"), "--out", path("set")};
    command.insert(command.end(), drawn.begin(), drawn.end());
    expectWrong(command, "--seed, --variation and --anywhere are for sim: sources");
  }
  recordRun();
  expectWrong({"export", "images", "record:" + path("run.rec"), "--out", path("set")},
              "--robot is missing");
}

}  // namespace
}  // namespace ortung::test
