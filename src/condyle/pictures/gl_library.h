#pragma once

/// OpenGL and OSMesa, opened when the first picture is drawn. OSMesa brings a compiler (LLVM) that
/// weighs more than all the rest of the program, and most commands draw nothing: they do not pay
/// for it. Within condyle the functions below stand in for those of their names.

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/osmesa.h>

// clang-format off
#define CONDYLE_GL_FUNCTIONS(X) \
  X(OSMesaCreateContextAttribs) X(OSMesaDestroyContext) X(OSMesaGetCurrentContext) \
  X(OSMesaMakeCurrent) X(glActiveTexture) X(glAttachShader) X(glBindBuffer) X(glBindFramebuffer) \
  X(glBindRenderbuffer) X(glBindTexture) X(glBindVertexArray) X(glBlendColor) X(glBlendFunc) \
  X(glBlitFramebuffer) X(glBufferData) X(glCheckFramebufferStatus) X(glClear) X(glClearBufferfv) \
  X(glClearColor) X(glColorMask) X(glCompileShader) X(glCreateProgram) X(glCreateShader) \
  X(glDeleteBuffers) X(glDeleteFramebuffers) X(glDeleteProgram) X(glDeleteRenderbuffers) \
  X(glDeleteShader) X(glDeleteTextures) X(glDeleteVertexArrays) X(glDepthFunc) X(glDisable) \
  X(glDrawArrays) X(glDrawElements) X(glEnable) X(glEnableVertexAttribArray) \
  X(glFramebufferRenderbuffer) X(glFramebufferTexture2D) X(glGenBuffers) X(glGenFramebuffers) \
  X(glGenRenderbuffers) X(glGenTextures) X(glGenVertexArrays) X(glGetIntegerv) X(glGetProgramiv) \
  X(glGetShaderInfoLog) X(glGetShaderiv) X(glGetUniformLocation) X(glLinkProgram) \
  X(glReadPixels) X(glRenderbufferStorageMultisample) X(glScissor) X(glShaderSource) \
  X(glTexParameteri) X(glTexStorage2D) X(glUniform1f) X(glUniform1i) X(glUniform2f) \
  X(glUniform3f) X(glUniform4f) X(glUniformMatrix4fv) X(glUseProgram) X(glVertexAttribPointer) X(glViewport)
// clang-format on

namespace condyle {

// NOLINTNEXTLINE(bugprone-macro-parentheses) a name is declared
#define CONDYLE_DECLARE(function) extern decltype(&::function) function;
CONDYLE_GL_FUNCTIONS(CONDYLE_DECLARE)
#undef CONDYLE_DECLARE

/// Finds all of them; the first call opens the library. Throws PictureError where it cannot.
void open_gl();

}  // namespace condyle
