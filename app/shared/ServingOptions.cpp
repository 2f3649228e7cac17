#include "ServingOptions.hpp"

namespace ortung::app {

void addDoor(Builder& build, ServingArguments& a) {
  const HelpGroup group(build, "Serving and viewing");
  build.option("--listen", a.listen,
               "[ADDRESS:]PORT for clients; 0: a free port; see docs/protocol.md. ADDRESS: "
               "127.0.0.1, others need --token-file");
  build
      .option("--allow-control", a.control,
              "Name of a client that may control what is served: pause, step, reset, drive a real "
              "robot, ...; 'all' for all; may be given again")
      .repeats();
  build.option(
      "--token-file", a.tokens,
      "File with a line 'NAME TOKEN' for each client that is admitted, * for any name without "
      "its own line");
  build.flag("--view", a.isViewing,
             "Show it in a web browser: the address is printed, and opened if there is a desktop");
  build
      .option("--view-host", a.hosts,
              "Name of this computer for browsers, besides localhost and its addresses; may "
              "be given again")
      .repeats();
  build.flag("--no-browser{false}", a.opensBrowser, "Print the address for browsers only");
}

void addRecording(Builder& build, ServingArguments& a) {
  const HelpGroup group(build, "Serving and viewing");
  build.option(
      "--record-into", a.recordInto,
      "With --listen or --view: folder for the records of robots that clients begin and end "
      "(RECORD)");
}

void addServing(Builder& build, ServingArguments& a) {
  const HelpGroup group(build, "Serving and viewing");
  addDoor(build, a);
  build.option("--idle", a.idle, "Silence after which clients are disconnected [s]")
      .within(1.0, 1e6)
      .showsDefault();
  build.option("--clients", a.clients, "Greatest number of clients")
      .within(1, 100000)
      .showsDefault();
  build
      .option("--clients-per-address", a.clientsOfAddress,
              "Greatest number of clients from one computer")
      .within(1, 100000)
      .showsDefault();
  build
      .option("--map-share", a.mapShare,
              "Share of one processor for clients' maps and other slow commands, together")
      .within(0.001, 1.0)
      .showsDefault();
  build.option("--speed", a.speed, "Speed relative to real time")
      .within(0.001, 1000.0)
      .showsDefault();
  build.flag("--free-run", a.freeRun, "As fast as possible instead of in real time");
  build.flag("--lockstep", a.lockstep,
             "The world advances only when all lockstep clients ask for it");
}

}  // namespace ortung::app
