#pragma once

/// OpenGL without a window: an OSMesa context, and owners of the few kinds of OpenGL objects used
/// here. Private to the room: include it in .cpp files only. Everything throws PictureError when
/// OpenGL refuses.

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

#include "condyle/pictures/gl_library.h"
#include "condyle/pictures/shaded_mesh.h"

namespace condyle {

/// Off-screen OpenGL 3.3 core, drawn by the processor.
class OffscreenContext {
 public:
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  void make_current();

 private:
  OSMesaContext context_;
  std::vector<std::uint8_t> buffer_;  // OSMesa wants one; pictures are drawn into textures instead
};

class ShaderProgram {
 public:
  ShaderProgram(const char* vertex_source, const char* fragment_source);
  ~ShaderProgram();
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;
  void use() const { glUseProgram(id_); }
  [[nodiscard]] GLint uniform(const char* name) const { return glGetUniformLocation(id_, name); }

 private:
  GLuint id_ = 0;
};

/// A mesh in OpenGL's memory; attributes 0 position, 1 normal, 2 colour.
class MeshBuffer {
 public:
  MeshBuffer();
  ~MeshBuffer();
  MeshBuffer(const MeshBuffer&) = delete;
  MeshBuffer& operator=(const MeshBuffer&) = delete;
  void fill(const ShadedMesh& mesh);
  /// Around all vertices; empty where there are none.
  [[nodiscard]] const Eigen::AlignedBox3f& box() const { return box_; }
  void draw() const;

 private:
  GLuint array_ = 0, vertices_ = 0, indices_ = 0;
  GLsizei count_ = 0;
  Eigen::AlignedBox3f box_;
};

/// A place to draw into: one colour image and, if asked, depth.
class Target {
 public:
  /// samples = 0: the colour is a texture that shaders can read; else a multisampled buffer.
  Target(int width, int height, GLenum color_format, bool depth, int samples = 0);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  void bind() const;
  void bind_texture(int unit) const;
  [[nodiscard]] GLuint framebuffer() const { return framebuffer_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  int width_, height_;
  GLuint framebuffer_ = 0, texture_ = 0, color_ = 0, depth_ = 0;
};

/// Largest number of samples per pixel not above `wanted`.
[[nodiscard]] int available_samples(int wanted);

}  // namespace condyle
