#include "ScenePainter.hpp"

#include <string>
#include <vector>

#include "FaceView.hpp"
#include "FloorPainter.hpp"
#include "GlContext.hpp"
#include "GlProgram.hpp"
#include "GlSheet.hpp"
#include "Shaders.hpp"
#include "SolidPainter.hpp"

namespace ortung {
namespace {

constexpr double kNear = 0.03;   ///< distance of the near plane [m]
constexpr double kFar = 4000.0;  ///< distance of the far plane [m]

/// A program for the floor, for lines or for solids, with the locations of their common uniforms.
struct Program : GlProgram {
  Program(const GlFunctions& gl, const char* definitions, const char* vertex, const char* fragment)
      : GlProgram(gl, definitions, {shaders::kHead, vertex}, {shaders::kHead, fragment}) {}
  GLint toClip = find("toClip");
  GLint origin = find("origin");
  GLint pixel = find("pixel");
};

/// The three programs of one mode of drawing.
struct Programs {
  Programs(const GlFunctions& gl, const char* definitions)
      : floor(gl, definitions, shaders::kFloorVertex, shaders::kFloorFragment),
        lines(gl, definitions, shaders::kLineVertex, shaders::kLineFragment),
        solids(gl, definitions, shaders::kSolidVertex, shaders::kSolidFragment) {}
  Program floor, lines, solids;
};

bool hasPattern(const Lighting& light) {
  return light.grain != 0.0F || light.patches != 0.0F || light.stripes != 0.0F;
}

}  // namespace

struct ScenePainter::Parts {
  explicit Parts(const StandingScene& all)
      : scene(all), context(GlContext::make()), gl(context->gl()) {
    const GlContext::Current current(*context);
    sheet = std::make_unique<GlSheet>(gl);
    floor = std::make_unique<FloorPainter>(gl, scene);
    solids = std::make_unique<SolidPainter>(gl, scene);
    plain = std::make_unique<Programs>(gl, "");
    gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Enable(GL_DEPTH_TEST);
    gl.CullFace(GL_BACK);
    gl.FrontFace(GL_CW);  // rows go downwards, so everything is mirrored
  }

  /// Programs are compiled when they are first needed.
  const Programs& programs(const Lighting& light, bool annotates) {
    std::unique_ptr<Programs>& wanted = annotates ? annotating : hasPattern(light) ? varied : plain;
    if (!wanted)
      wanted =
          std::make_unique<Programs>(gl, annotates ? "#define ANNOTATE\n" : "#define VARIED\n");
    return *wanted;
  }

  void tell(const Drawing& drawing, const Programs& programs) const;
  void paint(const Drawing& drawing, const Programs& programs, bool annotates);
  void paintFloor(const Programs& programs, std::size_t face, float pixel, bool annotates,
                  const std::array<float, 16>& toClip, const std::array<double, 3>& camera);

  const StandingScene& scene;
  std::unique_ptr<GlContext> context;
  const GlFunctions& gl;
  std::unique_ptr<GlSheet> sheet;
  std::unique_ptr<FloorPainter> floor;
  std::unique_ptr<SolidPainter> solids;
  std::unique_ptr<Programs> plain, varied, annotating;
  std::vector<FaceView> faces;
};

/// Sets the uniforms that are the same for all faces.
void ScenePainter::Parts::tell(const Drawing& drawing, const Programs& programs) const {
  const Lighting& light = drawing.lighting;
  const std::array<double, 3>& camera = drawing.camera.position;
  const std::array<float, 3> origin{static_cast<float>(scene.middle.x - camera[0]),
                                    static_cast<float>(scene.middle.y - camera[1]),
                                    static_cast<float>(-camera[2])};
  for (const Program* program : {&programs.floor, &programs.lines, &programs.solids}) {
    program->use();
    gl.Uniform3fv(program->find("light"), 1, light.towardsLight.data());
    gl.Uniform1f(program->find("ambient"), light.ambient);
    gl.Uniform3fv(program->find("lightColour"), 1, light.colour.data());
    gl.Uniform3fv(program->origin, 1, origin.data());
  }
  const Program& floorIs = programs.floor;
  floorIs.use();
  const Rgb& field = scene.isPitch ? light.turf : light.ground;
  gl.Uniform3fv(floorIs.find("turf"), 1, field.data());
  gl.Uniform3fv(floorIs.find("ground"), 1, light.ground.data());
  const std::array<float, 3> at{static_cast<float>(camera[0]), static_cast<float>(camera[1]),
                                static_cast<float>(camera[2])};
  gl.Uniform3fv(floorIs.find("camera"), 1, at.data());
  gl.Uniform1f(floorIs.find("grain"), light.grain);
  gl.Uniform1f(floorIs.find("patches"), light.patches);
  gl.Uniform4f(floorIs.find("stripes"), light.stripes, light.stripeWidth,
               -std::sin(light.stripeAngle), std::cos(light.stripeAngle));
  gl.Uniform1ui(floorIs.find("seed"), light.seed);
}

/// Draws the floor and its lines. The floor hides nothing and lines lie on it, so no depth test is
/// needed.
void ScenePainter::Parts::paintFloor(const Programs& programs, std::size_t face, float pixel,
                                     bool annotates, const std::array<float, 16>& toClip,
                                     const std::array<double, 3>& camera) {
  gl.DepthFunc(GL_ALWAYS);
  gl.Disable(GL_CULL_FACE);
  programs.floor.use();
  gl.UniformMatrix4fv(programs.floor.toClip, 1, GL_FALSE, toClip.data());
  floor->paintFloor();
  gl.DepthMask(GL_FALSE);
  if (!annotates) gl.Enable(GL_BLEND);
  programs.lines.use();
  gl.UniformMatrix4fv(programs.lines.toClip, 1, GL_FALSE, toClip.data());
  gl.Uniform1f(programs.lines.pixel, pixel);
  floor->paintLines(faces[face], camera);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
}

void ScenePainter::Parts::paint(const Drawing& drawing, const Programs& programs, bool annotates) {
  tell(drawing, programs);
  const std::array<double, 3>& camera = drawing.camera.position;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const SheetFace& face = drawing.faces[i];
    gl.Viewport(face.column, face.row, face.width, face.height);
    gl.Scissor(face.column, face.row, face.width, face.height);
    const std::array<float, 16> toClip = faces[i].toClip(face, kNear, kFar);
    const double pixel =
        std::max((face.right - face.left) / face.width, (face.bottom - face.top) / face.height);
    paintFloor(programs, i, static_cast<float>(pixel), annotates, toClip, camera);
    programs.solids.use();
    gl.UniformMatrix4fv(programs.solids.toClip, 1, GL_FALSE, toClip.data());
    solids->paintWalls(faces[i], camera);
    gl.Enable(GL_CULL_FACE);
    solids->paintBodies(i);
    if (annotates) continue;
    gl.Enable(GL_BLEND);
    gl.DepthMask(GL_FALSE);
    solids->paintNets(i);
    gl.DepthMask(GL_TRUE);
    gl.Disable(GL_BLEND);
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
  const auto begin = [&] {
    p.gl.Scissor(0, 0, drawing.width, drawing.height);
    p.gl.DepthMask(GL_TRUE);
  };
  if (!sheet.colours.empty()) {
    begin();
    p.sheet->beginColours(drawing.lighting.background);
    p.paint(drawing, p.programs(drawing.lighting, false), false);
    p.sheet->readColours(drawing.width, drawing.height, sheet.colours.data());
  }
  if (sheet.things.empty() && sheet.ranges.empty()) return;
  begin();
  p.sheet->beginThings();
  p.paint(drawing, p.programs(drawing.lighting, true), true);
  p.sheet->readThings(drawing.width, drawing.height, sheet);
}

}  // namespace ortung
