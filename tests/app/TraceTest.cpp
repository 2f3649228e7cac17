#include "Golden.hpp"
#include "Workspace.hpp"

namespace ortung::test {
namespace {

// Nothing has moved yet, so all is as the files say.
TEST_F(Workspace, TraceOfASceneIsWrittenAsItWas) {
  write("hall.toml", read("hall.toml") +
                         "[[ellipse]]\nkind = \"ball\"\nname = \"a,b\"\ncenter_m = [0.5, -1.25]\n"
                         "size_m = [0.22, 0.22]\nz_m = [0, 0.22]\nmovable = true\nmass_kg = 0.4\n");
  write("robot.toml",
        read("robot.toml") +
            "[[manipulator]]\nname = \"kicker\"\n[[manipulator.state]]\nname = \"in\"\n"
            "[[manipulator]]\nname = \"flaps\"\n[[manipulator.state]]\nname = \"open\"\n");
  write("scene.toml",
        "[scene]\nworld = \"hall.toml\"\n[[robot]]\nfile = \"robot.toml\"\nname = \"anna\"\n"
        "start = { x_m = -1.5, y_m = 0.25, theta_deg = 90 }\n");
  const Outcome outcome = ortung({"sim", path("scene.toml"), "--duration", "0.02", "--free-run",
                                  "--trace", path("trace.csv")});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  expectGolden("trace.csv", read("trace.csv"));
}

}  // namespace
}  // namespace ortung::test
