// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/offscreen.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace geomap::viewer {
namespace {

[[noreturn]] void fail(const char* step) {
  throw std::runtime_error(
      fmt::format("no drawing off the screen: {} (EGL error {:#x}); is Mesa (libgl1-mesa-dri, "
                  "libegl1) installed?",
                  step, eglGetError()));
}

bool is_started(EGLDisplay display) {
  return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE;
}

// Mesa's display that belongs to no screen, or else whatever is the default one.
EGLDisplay started_display() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    const EGLDisplay surfaceless =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (is_started(surfaceless)) return surfaceless;
  }
  const EGLDisplay usual = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (!is_started(usual)) fail("EGL has no display");
  return usual;
}

EGLContext made_context(EGLDisplay display) {
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("EGL does not know OpenGL");
  const std::array<EGLint, 5> wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                        EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &configs) != EGL_TRUE || configs < 1) {
    fail("EGL has no OpenGL configuration");
  }
  const std::array<EGLint, 7> version = {EGL_CONTEXT_MAJOR_VERSION,
                                         3,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
}

}  // namespace

OffscreenContext::OffscreenContext() : display_(started_display()) {
  context_ = made_context(display_);
  if (context_ == EGL_NO_CONTEXT) fail("EGL makes no OpenGL 3.3 context");
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    eglDestroyContext(display_, context_);
    fail("the context works only with a window");
  }
}

OffscreenContext::~OffscreenContext() {
  // The display stays: EGL has one for the whole process, which others may use.
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

std::string OffscreenContext::renderer() const {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? "unknown" : reinterpret_cast<const char*>(name);
}

}  // namespace geomap::viewer
