// The only file that knows where OpenGL comes from.
#include "GlContext.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdlib.h>

#include <array>
#include <mutex>
#include <stdexcept>
#include <string>

#include "ortung/sim/OpenGl.hpp"

namespace ortung {
namespace {

/// A library that stays loaded.
class Library {
 public:
  explicit Library(const char* name) : name_(name) {
    // Set before the renderer reads it; a value of the user is kept.
    ::setenv("LP_NUM_THREADS", "0", 0);
    handle_ = ::dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (handle_ == nullptr) throw std::runtime_error(::dlerror());
  }
  template <class Function>
  Function find(const char* symbol) const {
    void* found = ::dlsym(handle_, symbol);
    if (found == nullptr) throw std::runtime_error(std::string(name_) + " has no " + symbol);
    return reinterpret_cast<Function>(found);
  }

 private:
  const char* name_;
  void* handle_ = nullptr;
};

template <class Lookup>
void loadFunctions(GlFunctions& gl, const Lookup& lookup) {
#define ORTUNG_GL_LOAD(type, name)                      \
  gl.name = reinterpret_cast<type>(lookup("gl" #name)); \
  if (gl.name == nullptr) throw std::runtime_error("OpenGL has no function gl" #name);
  ORTUNG_GL_FUNCTIONS(ORTUNG_GL_LOAD)
#undef ORTUNG_GL_LOAD
}

// --- OSMesa

struct OsMesa {
  Library library{"libOSMesa.so.8"};
  decltype(&::OSMesaCreateContextAttribs) create =
      library.find<decltype(create)>("OSMesaCreateContextAttribs");
  decltype(&::OSMesaMakeCurrent) makeCurrent =
      library.find<decltype(makeCurrent)>("OSMesaMakeCurrent");
  decltype(&::OSMesaDestroyContext) destroy =
      library.find<decltype(destroy)>("OSMesaDestroyContext");
  decltype(&::OSMesaGetProcAddress) lookup = library.find<decltype(lookup)>("OSMesaGetProcAddress");
};

class OsMesaContext final : public GlContext {
 public:
  explicit OsMesaContext(const OsMesa& mesa) : mesa_(mesa) {
    constexpr std::array kWanted{OSMESA_FORMAT,
                                 OSMESA_RGBA,
                                 OSMESA_DEPTH_BITS,
                                 0,
                                 OSMESA_PROFILE,
                                 OSMESA_CORE_PROFILE,
                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                 3,
                                 OSMESA_CONTEXT_MINOR_VERSION,
                                 3,
                                 0};
    context_ = mesa_.create(kWanted.data(), nullptr);
    if (context_ == nullptr) throw std::runtime_error("OSMesa has no context of OpenGL 3.3");
    try {
      const Current current(*this);
      loadFunctions(gl_, mesa_.lookup);
    } catch (...) {
      mesa_.destroy(context_);
      throw;
    }
  }
  ~OsMesaContext() override { mesa_.destroy(context_); }
  const char* backEnd() const override { return "osmesa"; }

 protected:
  void bind() override {
    // We draw into buffers of our own, so the buffer that OSMesa requires is never touched.
    if (mesa_.makeCurrent(context_, unused_.data(), GL_UNSIGNED_BYTE, 1, 1) == 0)
      throw std::runtime_error("OSMesa's context can't be used");
  }
  void release() noexcept override { mesa_.makeCurrent(nullptr, nullptr, 0, 0, 0); }

 private:
  const OsMesa& mesa_;
  OSMesaContext context_ = nullptr;
  std::array<std::uint32_t, 4> unused_{};
};

// --- EGL

struct Egl {
  Library library{"libEGL.so.1"};
  decltype(&::eglGetProcAddress) lookup = library.find<decltype(lookup)>("eglGetProcAddress");
  decltype(&::eglInitialize) initialize = library.find<decltype(initialize)>("eglInitialize");
  decltype(&::eglBindAPI) bindApi = library.find<decltype(bindApi)>("eglBindAPI");
  decltype(&::eglChooseConfig) choose = library.find<decltype(choose)>("eglChooseConfig");
  decltype(&::eglCreateContext) create = library.find<decltype(create)>("eglCreateContext");
  decltype(&::eglMakeCurrent) makeCurrent = library.find<decltype(makeCurrent)>("eglMakeCurrent");
  decltype(&::eglDestroyContext) destroy = library.find<decltype(destroy)>("eglDestroyContext");
  decltype(&::eglReleaseThread) releaseThread =
      library.find<decltype(releaseThread)>("eglReleaseThread");
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLConfig config = nullptr;

  Egl() {
    const auto open =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(lookup("eglGetPlatformDisplayEXT"));
    if (open == nullptr) throw std::runtime_error("EGL has no eglGetPlatformDisplayEXT");
    display = open(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display == EGL_NO_DISPLAY || initialize(display, nullptr, nullptr) != EGL_TRUE)
      throw std::runtime_error("EGL can't do without a display (EGL_PLATFORM_SURFACELESS_MESA)");
    constexpr std::array<EGLint, 5> kWanted{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE,
                                            EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (choose(display, kWanted.data(), &config, 1, &count) != EGL_TRUE || count < 1)
      throw std::runtime_error("EGL has no configuration with OpenGL");
  }
};

class EglContext final : public GlContext {
 public:
  explicit EglContext(const Egl& egl) : egl_(egl) {
    constexpr std::array<EGLint, 7> kWanted{EGL_CONTEXT_MAJOR_VERSION,
                                            3,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            3,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
    egl_.bindApi(EGL_OPENGL_API);
    context_ = egl_.create(egl_.display, egl_.config, EGL_NO_CONTEXT, kWanted.data());
    if (context_ == EGL_NO_CONTEXT) throw std::runtime_error("EGL has no context of OpenGL 3.3");
    try {
      const Current current(*this);
      loadFunctions(gl_, egl_.lookup);
    } catch (...) {
      egl_.destroy(egl_.display, context_);
      throw;
    }
  }
  ~EglContext() override { egl_.destroy(egl_.display, context_); }
  const char* backEnd() const override { return "egl"; }

 protected:
  void bind() override {
    egl_.bindApi(EGL_OPENGL_API);  // the bound API is a setting of each thread
    if (egl_.makeCurrent(egl_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
      throw std::runtime_error("EGL's context can't be used without a surface");
  }
  void release() noexcept override {
    egl_.makeCurrent(egl_.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

 private:
  const Egl& egl_;
  ::EGLContext context_ = EGL_NO_CONTEXT;
};

/// Opens a library once and never closes it, which these libraries do not survive.
template <class Opened>
const Opened& opened() {
  static const Opened* const kOpened = new Opened;
  return *kOpened;
}

template <class Context, class Opened>
std::unique_ptr<GlContext> attempt(std::string& why) {
  try {
    return std::make_unique<Context>(opened<Opened>());
  } catch (const std::runtime_error& error) {
    why += std::string(why.empty() ? "" : "; ") + error.what();
    return nullptr;
  }
}

}  // namespace

GlContext::~GlContext() = default;

std::unique_ptr<GlContext> GlContext::make() {
  static std::mutex* const mutex =
      new std::mutex;  // never destroyed, so that it outlives all threads
  const std::lock_guard lock(*mutex);
  const char* const set = ::getenv("ORTUNG_GL");
  const std::string wanted = set == nullptr ? "" : set;
  if (!wanted.empty() && wanted != "osmesa" && wanted != "egl")
    throw std::runtime_error("ORTUNG_GL is \"" + wanted + "\", expected osmesa or egl");
  std::string why;
  if (wanted != "egl")
    if (auto context = attempt<OsMesaContext, OsMesa>(why)) return context;
  if (wanted != "osmesa")
    if (auto context = attempt<EglContext, Egl>(why)) return context;
  throw std::runtime_error(
      "no picture can be drawn here, since there is no OpenGL 3.3 without a window (" + why +
      "): install libosmesa6, or libegl1 and libegl-mesa0");
}

std::string openGlRenderer() {
  const std::unique_ptr<GlContext> context = GlContext::make();
  const GlContext::Current current(*context);
  const auto* name = reinterpret_cast<const char*>(context->gl().GetString(GL_RENDERER));
  return std::string(context->backEnd()) + ": " + (name == nullptr ? "of no name" : name);
}

}  // namespace ortung
