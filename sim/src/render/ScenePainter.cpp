#include "ScenePainter.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "FaceView.hpp"
#include "FloorPainter.hpp"
#include "GlContext.hpp"
#include "GlProgram.hpp"
#include "GlSheet.hpp"
#include "Shaders.hpp"
#include "SolidPainter.hpp"
#include "TurfPattern.hpp"

namespace ortung {
namespace {

constexpr double kNear = 0.03;    ///< distance of the near plane [m]
constexpr double kFar = 20000.0;  ///< distance of the far plane [m]

/// Directions whose slope is at least this meet the floor where it is drawn.
constexpr double kSurelyFloor = 0.01;

/// A program for the floor, for lines or for solids, with the locations of their uniforms.
struct Program : GlProgram {
  Program(const GlFunctions& gl, const std::string& definitions, const char* vertex,
          const char* fragment)
      : GlProgram(gl, definitions, {shaders::kHead, vertex}, {shaders::kHead, fragment}) {}
  GLint toClip = find("toClip");
  GLint origin = find("origin");
  GLint pixel = find("pixel");
  GLint paint = find("paint");
  GLint isSheet = find("isSheet");
};

Rgb lit(const Rgb& colour, const Lighting& light) {
  return {colour[0] * light.colour[0], colour[1] * light.colour[1], colour[2] * light.colour[2]};
}

/// What a face may show besides the field.
struct Beyond {
  bool ground = false;   ///< whether it may show the floor around the field
  bool horizon = false;  ///< whether it may show anything but floor
};

Beyond beyondIn(const Drawing& drawing, const SheetFace& face, const FaceView& view,
                const StandingScene& scene) {
  Beyond beyond;
  const std::array<double, 3>& at = drawing.camera.position;
  const Box2& field = scene.field;
  // A view is convex, and so is the field: what holds for the corners holds in between.
  for (const auto& [u, v] : {std::pair{face.left, face.top},
                             {face.right, face.top},
                             {face.left, face.bottom},
                             {face.right, face.bottom}}) {
    const auto [x, y, z] = view.direction(u, v, 1.0);
    if (!(at[2] > 0.0) || !(z < -kSurelyFloor * std::hypot(x, y, z))) return {true, true};
    const double px = at[0] - scene.middle.x - x * at[2] / z;
    const double py = at[1] - scene.middle.y - y * at[2] / z;
    beyond.ground =
        beyond.ground || px < field.xLow || px > field.xHigh || py < field.yLow || py > field.yHigh;
  }
  return beyond;
}

}  // namespace

struct ScenePainter::Parts {
  explicit Parts(const StandingScene& all)
      : scene(all), context(GlContext::make()), gl(context->gl()) {
    const GlContext::Current current(*context);
    sheet = std::make_unique<GlSheet>(gl);
    floor = std::make_unique<FloorPainter>(gl, scene);
    solids = std::make_unique<SolidPainter>(gl, scene);
    const auto program = [&](const char* vertex, const char* fragment) {
      return std::make_unique<Program>(gl, "", vertex, fragment);
    };
    ground = program(shaders::kFloorVertex, shaders::kFloorFragment);
    lines = program(shaders::kLineVertex, shaders::kLineFragment);
    bodies = program(shaders::kSolidVertex, shaders::kSolidFragment);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Enable(GL_DEPTH_TEST);
    gl.CullFace(GL_BACK);
    gl.FrontFace(GL_CW);  // rows go downwards, so everything is mirrored
  }

  Rgb fieldColour(const Lighting& light) const {
    return lit(scene.isPitch ? light.turf : light.ground, light);
  }

  void tell(const Drawing& drawing) const;
  void paint(const Drawing& drawing);
  void paintFloor(const Drawing& drawing, std::size_t face, const std::array<float, 16>& toClip);
  void paintLines(const Drawing& drawing, std::size_t face, const std::array<float, 16>& toClip);
  void paintSolids(const Drawing& drawing, std::size_t face, const std::array<float, 16>& toClip);

  const StandingScene& scene;
  std::unique_ptr<GlContext> context;
  const GlFunctions& gl;
  std::unique_ptr<GlSheet> sheet;
  std::unique_ptr<FloorPainter> floor;
  std::unique_ptr<SolidPainter> solids;
  std::unique_ptr<Program> ground, lines, bodies;
  std::vector<FaceView> faces;
};

/// Sets the uniforms that are the same for all faces.
void ScenePainter::Parts::tell(const Drawing& drawing) const {
  const Lighting& light = drawing.lighting;
  const std::array<double, 3>& camera = drawing.camera.position;
  const std::array<float, 3> origin{static_cast<float>(scene.middle.x - camera[0]),
                                    static_cast<float>(scene.middle.y - camera[1]),
                                    static_cast<float>(-camera[2])};
  for (const Program* program :
       std::initializer_list<const Program*>{ground.get(), lines.get(), bodies.get()}) {
    program->use();
    gl.Uniform3fv(program->find("light"), 1, light.towardsLight.data());
    gl.Uniform1f(program->find("ambient"), light.ambient);
    gl.Uniform3fv(program->find("lightColour"), 1, light.colour.data());
    gl.Uniform3fv(program->origin, 1, origin.data());
  }
}

/// Draws what is around the field: the field itself has been drawn by clearing the sheet with its
/// colour. It hides nothing, so no depths are needed.
void ScenePainter::Parts::paintFloor(const Drawing& drawing, std::size_t face,
                                     const std::array<float, 16>& toClip) {
  const Lighting& light = drawing.lighting;
  const Beyond beyond = beyondIn(drawing, drawing.faces[face], faces[face], scene);
  ground->use();
  gl.UniformMatrix4fv(ground->toClip, 1, GL_FALSE, toClip.data());
  const auto dip = [&](const Rgb& colour, float isFloor) {
    gl.Uniform4f(ground->paint, colour[0], colour[1], colour[2], 1.0F - isFloor);
  };
  if (beyond.ground && scene.isPitch) {
    dip(lit(light.ground, light), 1.0F);
    floor->paintGround();
  }
  if (beyond.horizon) {
    dip(light.background, 0.0F);
    floor->paintHorizon();
  }
}

void ScenePainter::Parts::paintLines(const Drawing& drawing, std::size_t face,
                                     const std::array<float, 16>& toClip) {
  const SheetFace& on = drawing.faces[face];
  const double pixel = std::max((on.right - on.left) / on.width, (on.bottom - on.top) / on.height);
  lines->use();
  gl.UniformMatrix4fv(lines->toClip, 1, GL_FALSE, toClip.data());
  gl.Uniform1f(lines->pixel, static_cast<float>(pixel));
  gl.Enable(GL_BLEND);
  floor->paintLines(faces[face], drawing.camera.position);
  gl.Disable(GL_BLEND);
}

void ScenePainter::Parts::paintSolids(const Drawing& drawing, std::size_t face,
                                      const std::array<float, 16>& toClip) {
  bodies->use();
  gl.UniformMatrix4fv(bodies->toClip, 1, GL_FALSE, toClip.data());
  gl.Uniform1f(bodies->isSheet, 1.0F);
  solids->paintWalls(faces[face], drawing.camera.position);
  gl.Uniform1f(bodies->isSheet, 0.0F);
  gl.Enable(GL_CULL_FACE);
  solids->paintBodies(face);
  gl.Enable(GL_BLEND);
  gl.DepthMask(GL_FALSE);
  solids->paintNets(face);
  gl.DepthMask(GL_TRUE);
  gl.Disable(GL_BLEND);
  gl.Disable(GL_CULL_FACE);
}

void ScenePainter::Parts::paint(const Drawing& drawing) {
  gl.Scissor(0, 0, drawing.width, drawing.height);
  sheet->begin(fieldColour(drawing.lighting));
  tell(drawing);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const SheetFace& face = drawing.faces[i];
    gl.Viewport(face.column, face.row, face.width, face.height);
    gl.Scissor(face.column, face.row, face.width, face.height);
    const std::array<float, 16> toClip = faces[i].toClip(face, kNear, kFar);
    gl.Disable(GL_DEPTH_TEST);
    paintFloor(drawing, i, toClip);
    paintLines(drawing, i, toClip);
    gl.Enable(GL_DEPTH_TEST);
    paintSolids(drawing, i, toClip);
  }
}

ScenePainter::ScenePainter(const StandingScene& scene) : parts_(std::make_unique<Parts>(scene)) {}

ScenePainter::~ScenePainter() = default;

const char* ScenePainter::backEnd() const { return parts_->context->backEnd(); }

void ScenePainter::draw(const Drawing& drawing, std::span<const Instance> moving,
                        const Sheet& sheet) {
  Parts& p = *parts_;
  const GlContext::Current current(*p.context);
  p.sheet->resize(drawing.width, drawing.height);
  p.faces.clear();
  for (const SheetFace& face : drawing.faces) p.faces.emplace_back(drawing.camera, face);
  p.solids->prepare(p.faces, drawing.camera.position, moving);
  p.paint(drawing);
  p.sheet->read(drawing.width, drawing.height, sheet.colours.data());
  if (TurfPattern::isIn(drawing.lighting))
    TurfPattern(p.scene, drawing.lighting).add(drawing, sheet.colours);
}

}  // namespace ortung
