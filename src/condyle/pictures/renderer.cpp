#include "condyle/pictures/renderer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>

#include "condyle/pictures/gl_objects.h"
#include "condyle/pictures/shaders.h"

namespace condyle {
namespace {

constexpr int kSamplesPerPixel = 4;
constexpr double kDepthRange = 2000;   // [mm] before and behind the target
constexpr double kOcclusionReach = 9;  // [mm]
// Cartilage is fitted to the same mesh that is drawn as bone: the bone steps back so that its
// roughness does not poke through [mm].
constexpr double kBoneStepsBack = 1.2;
constexpr float kMarkOpacity = 0.92F;
constexpr float kNothing = -10000;  // height where no surface is [mm]

/// Half the size of the picture, for geometry and occlusion.
int half(int size) { return (size + 1) / 2; }

}  // namespace

struct Renderer::State {
  int width, height;
  OffscreenContext context;
  ShaderProgram geometry{shaders::kMeshVertex, shaders::kGeometryFragment};
  ShaderProgram occlusion{shaders::kPageVertex, shaders::kOcclusionFragment};
  ShaderProgram smooth{shaders::kPageVertex, shaders::kSmoothFragment};
  ShaderProgram depth{shaders::kMeshVertex, shaders::kDepthFragment};
  ShaderProgram shading{shaders::kMeshVertex, shaders::kShadeFragment};
  Target surfaces{half(width), half(height), GL_RGBA32F, true};
  Target noisy{half(width), half(height), GL_RG32F, false};
  Target light{half(width), half(height), GL_R8, false};
  Target page{width, height, GL_RGBA8, true, available_samples(kSamplesPerPixel)};
  Target resolved{width, height, GL_RGBA8, false};
  GLuint no_vertices = 0;
  std::vector<std::unique_ptr<MeshBuffer>> meshes;

  State(int w, int h) : width(w), height(h) { glGenVertexArrays(1, &no_vertices); }
  ~State() {
    context.make_current();  // the objects above are about to be deleted in it
    glDeleteVertexArrays(1, &no_vertices);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void set_camera(const ShaderProgram& program, const Camera& camera) const;
  void draw(const ShaderProgram& program,
            const Camera& camera,
            const std::vector<Item>& items,
            Layer layer) const;
  void limit_to(const Camera& camera, const std::vector<Item>& items) const;
  void find_light(const Camera& camera, const std::vector<Item>& items) const;
  void draw_page(const Camera& camera, const std::vector<Item>& items, const Fade& fade) const;
  void set_fade(const Fade& fade) const;
  [[nodiscard]] Image read_back() const;
};

void Renderer::State::set_camera(const ShaderProgram& program, const Camera& camera) const {
  const double sx = 2 / (width * camera.mm_per_pixel), sy = 2 / (height * camera.mm_per_pixel);
  program.use();
  glUniform3f(program.uniform("scale"), static_cast<float>(sx), static_cast<float>(sy),
              static_cast<float>(-1 / kDepthRange));
  glUniform3f(program.uniform("shift"), static_cast<float>(2 * camera.center.x() / width - 1),
              static_cast<float>(1 - 2 * camera.center.y() / height), 0);
}

void Renderer::State::draw(const ShaderProgram& program,
                           const Camera& camera,
                           const std::vector<Item>& items,
                           Layer layer) const {
  glUniform1f(program.uniform("push"),
              layer == Layer::kBone ? static_cast<float>(kBoneStepsBack) : 0);
  for (const Item& item : items) {
    if (item.layer != layer) continue;
    Eigen::Matrix4f X_VM = Eigen::Matrix4f::Identity();
    X_VM.topLeftCorner<3, 3>() = (camera.R_VP * item.X_PM.R).cast<float>();
    X_VM.topRightCorner<3, 1>() = (camera.R_VP * (item.X_PM.p - camera.target)).cast<float>();
    glUniformMatrix4fv(program.uniform("X_VM"), 1, GL_FALSE, X_VM.data());
    glUniform1f(program.uniform("gloss"), static_cast<float>(item.gloss));
    if (item.closed) glEnable(GL_CULL_FACE);
    meshes[static_cast<std::size_t>(item.mesh)]->draw();
    glDisable(GL_CULL_FACE);
  }
}

/// Restricts the passes over the page at half size to where something is drawn, and a rim that
/// smoothing looks at.
void Renderer::State::limit_to(const Camera& camera, const std::vector<Item>& items) const {
  Eigen::AlignedBox2d covered;
  for (const Item& item : items) {
    const Eigen::AlignedBox3f& box = meshes[static_cast<std::size_t>(item.mesh)]->box();
    if (box.isEmpty() || item.layer == Layer::kMark) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const auto which = static_cast<Eigen::AlignedBox3f::CornerType>(corner);
      covered.extend(camera.project(item.X_PM * box.corner(which).cast<double>()).head<2>().eval());
    }
  }
  if (covered.isEmpty()) covered.extend(Eigen::Vector2d(0, 0));
  constexpr double kRim = 4;  // [pixel] at half size
  const double high = surfaces.height();
  const Eigen::Vector2d low = 0.5 * covered.min(), top = 0.5 * covered.max();
  const auto within = [](double x, double end) {
    return static_cast<GLint>(std::clamp(x, 0.0, end));
  };
  const GLint left = within(low.x() - kRim, surfaces.width()),
              right = within(top.x() + kRim + 1, surfaces.width()),
              bottom = within(high - top.y() - kRim, high),
              upper = within(high - low.y() + kRim + 1, high);
  glScissor(left, bottom, std::max(1, right - left), std::max(1, upper - bottom));
  glEnable(GL_SCISSOR_TEST);
}

/// Ambient occlusion of the nearest surface, solid or bone.
void Renderer::State::find_light(const Camera& camera, const std::vector<Item>& items) const {
  const auto mm_per_pixel = static_cast<float>(camera.mm_per_pixel * width / surfaces.width());
  surfaces.bind();
  const float nothing[4] = {0, 0, 1, kNothing};
  glClearBufferfv(GL_COLOR, 0, nothing);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  set_camera(geometry, camera);
  for (const Layer layer : {Layer::kSolid, Layer::kBone}) draw(geometry, camera, items, layer);

  glDisable(GL_DEPTH_TEST);
  limit_to(camera, items);
  glBindVertexArray(no_vertices);
  surfaces.bind_texture(0);
  noisy.bind();
  occlusion.use();
  glUniform1i(occlusion.uniform("geometry"), 0);
  glUniform1f(occlusion.uniform("mm_per_pixel"), mm_per_pixel);
  glUniform1f(occlusion.uniform("reach"), static_cast<float>(kOcclusionReach));
  glDrawArrays(GL_TRIANGLES, 0, 3);

  light.bind();
  noisy.bind_texture(1);
  smooth.use();
  glUniform1i(smooth.uniform("noisy"), 1);
  glUniform1f(smooth.uniform("mm_per_pixel"), mm_per_pixel);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
}

/// OpenGL counts rows from below.
void Renderer::State::set_fade(const Fade& fade) const {
  const bool whole = !(fade.frame.right > fade.frame.left);
  const Frame paper =
      whole ? Frame{0, 0, static_cast<double>(width), static_cast<double>(height)} : fade.frame;
  glUniform4f(shading.uniform("paper"), static_cast<float>(paper.left),
              static_cast<float>(height - paper.bottom), static_cast<float>(paper.right),
              static_cast<float>(height - paper.top));
  glUniform1f(shading.uniform("fade"), static_cast<float>(std::max(1e-3, fade.width)));
}

void Renderer::State::draw_page(const Camera& camera,
                                const std::vector<Item>& items,
                                const Fade& fade) const {
  page.bind();
  glClearColor(1, 1, 1, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  light.bind_texture(2);
  set_camera(shading, camera);
  glUniform1i(shading.uniform("occlusion"), 2);
  glUniform2f(shading.uniform("page"), static_cast<float>(width), static_cast<float>(height));
  set_fade(fade);
  draw(shading, camera, items, Layer::kSolid);

  // The page's alpha now says how far the solid there shows through bone, 0 where there is none. Of
  // the bones the nearest surface is mixed with it: depth first, then colour where the depth is
  // equal.
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  set_camera(depth, camera);
  draw(depth, camera, items, Layer::kBone);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_EQUAL);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_DST_ALPHA);
  shading.use();
  draw(shading, camera, items, Layer::kBone);
  glDepthFunc(GL_LESS);

  glClear(GL_DEPTH_BUFFER_BIT);
  glBlendColor(1, 1, 1, kMarkOpacity);
  glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
  draw(shading, camera, items, Layer::kMark);
  glDisable(GL_BLEND);
}

Image Renderer::State::read_back() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, page.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved.framebuffer());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved.framebuffer());
  std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  Image image{width, height, std::vector<std::uint8_t>(rgba.size() / 4 * 3)};
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = rgba.data() + 4 * static_cast<std::size_t>(width) *
                                                 static_cast<std::size_t>(height - 1 - y);
    std::uint8_t* to = image.rgb.data() + image.offset(0, y);
    for (int x = 0; x < width; ++x, from += 4, to += 3) std::copy(from, from + 3, to);
  }
  return image;
}

Renderer::Renderer(int width, int height) : state_(std::make_unique<State>(width, height)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

int Renderer::add(const ShadedMesh& mesh) {
  state_->context.make_current();
  state_->meshes.push_back(std::make_unique<MeshBuffer>());
  state_->meshes.back()->fill(mesh);
  return static_cast<int>(state_->meshes.size()) - 1;
}

void Renderer::replace(int id, const ShadedMesh& mesh) {
  state_->context.make_current();
  state_->meshes[static_cast<std::size_t>(id)]->fill(mesh);
}

Image Renderer::render(const Camera& camera, const std::vector<Item>& items, const Fade& fade) {
  state_->context.make_current();
  state_->find_light(camera, items);
  state_->draw_page(camera, items, fade);
  return state_->read_back();
}

}  // namespace condyle
