#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "platform/render/gles/buffers.h"
#include "platform/render/gles/gl.h"
#include "platform/render/gles/overlay.h"
#include "platform/render/gles/shaders.h"
#include "platform/render/gles/target.h"
#include "platform/render/gles/textures.h"

namespace caryatid::platform {
namespace gles {
namespace {

void set_error(ErrorLine& out, const char* text) { out.assign({text, std::strlen(text)}); }

// The exact sRGB curve, for the few colours that go to the framebuffer without a shader's own.
float to_srgb(float linear) {
  const float c = std::clamp(linear, 0.0f, 1.0f);
  return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
}
Vec3 to_srgb(Vec3 c) { return {to_srgb(c.x), to_srgb(c.y), to_srgb(c.z)}; }

class GlesRenderer final : public Renderer {
 public:
  GlesRenderer(const pack::View& pack, const RenderOptions& options)
      : pack_(pack), options_(options) {}
  ~GlesRenderer() override { glDeleteBuffers(1, &quad_buffer_); }

  Status open(bool base_only, ErrorLine& out_error);
  const GpuCaps& caps() const override { return caps_; }
  std::uint32_t width() const override { return target_.width(); }
  std::uint32_t height() const override { return target_.height(); }
  Status upload_texture(std::uint16_t texture, bool all_levels) override {
    return textures_.upload(pack_, caps_, texture, all_levels);
  }
  Status load_font(const pack::FontView& font) override { return overlay_.load_font(font); }
  Status load_picture(std::uint16_t index, std::uint16_t width, std::uint16_t height,
                      std::span<const std::uint16_t> rgb565) override {
    return overlay_.load_picture(index, width, height, rgb565);
  }
  Status resize(std::uint32_t width, std::uint32_t height) override {
    return target_.create(width, height);
  }
  Status draw(const scene::DrawList& list) override;
  Status read_back(std::span<std::uint8_t> out_rgb) override;
  FrameCost last_cost() const override { return cost_; }

 private:
  void draw_items(const scene::DrawList& list, Pass pass);
  void draw_item(const scene::DrawList& list, const scene::DrawItem& item, Pass pass);
  void use(Program& program, const scene::DrawList& list);
  void draw_background(const scene::DrawList& list);
  void draw_floor_shadows(const scene::DrawList& list);
  void draw_overlay(const scene::Overlay& overlay);
  void bind_quad();
  void set_attributes(bool mesh);
  bool context_lost() const {
    return extra_.reset_status != nullptr && extra_.reset_status() != GL_NO_ERROR;
  }

  pack::View pack_;
  RenderOptions options_;
  Extra extra_;
  GpuCaps caps_;
  Target target_{caps_, extra_, options_};
  Programs programs_;
  Textures textures_;
  OverlayDrawer overlay_;
  std::array<MeshBuffers, kMaxObjects> meshes_;
  GLuint quad_buffer_ = 0;
  Mat4 view_projection_{1.0f};
  FrameCost cost_;
  std::uint32_t frame_ = 0;
  bool all_valid_ = true;
};

Status GlesRenderer::open(bool base_only, ErrorLine& out_error) {
  caps_ = query_caps(options_.clamp, options_.proc_address, extra_);
  if (caps_.vertex_attributes < kAttributeCount || caps_.vertex_vectors < kVertexVectorsUsed ||
      caps_.fragment_vectors < 16 || caps_.varying_vectors < 8) {
    set_error(out_error, "the GPU is below the limits of OpenGL ES 2.0");
    return fail(RenderFault::caps);
  }
  CARYATID_TRY(programs_.create(pack_, out_error));
  if (const Status status = textures_.create(pack_, caps_, base_only); !status.ok()) {
    set_error(out_error, "a texture of the pack cannot be loaded; bake the pack again");
    return status;
  }
  const std::size_t object_count = std::min(pack_.objects.size(), meshes_.size());
  for (std::size_t i = 0; i < object_count; ++i) meshes_[i].create(pack_.objects[i]);
  constexpr float kQuad[] = {0, 0, 1, 0, 0, 1, 1, 1};
  glGenBuffers(1, &quad_buffer_);
  glBindBuffer(GL_ARRAY_BUFFER, quad_buffer_);
  glBufferData(GL_ARRAY_BUFFER, sizeof kQuad, kQuad, GL_STATIC_DRAW);
  if (const Status status = target_.create(options_.width, options_.height); !status.ok()) {
    set_error(out_error, "the GPU refuses an own framebuffer of this size; try a smaller --size");
    return status;
  }
  if (glGetError() == GL_NO_ERROR) return {};
  set_error(out_error, "the GPU has too little memory for this pack");
  return fail(RenderFault::memory, Code::out_of_capacity);
}

void GlesRenderer::set_attributes(bool mesh) {
  for (GLuint i = 0; i < kAttributeCount; ++i) {
    if (mesh || i == kPosition)
      glEnableVertexAttribArray(i);
    else
      glDisableVertexAttribArray(i);
  }
}

void GlesRenderer::bind_quad() {
  set_attributes(false);
  glBindBuffer(GL_ARRAY_BUFFER, quad_buffer_);
  glVertexAttribPointer(kPosition, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
}

// Sets the program; camera and lights once a frame.
void GlesRenderer::use(Program& program, const scene::DrawList& list) {
  glUseProgram(program.name);
  if (program.frame == frame_) return;
  program.frame = frame_;
  const auto set = [](GLint at, Vec3 v) { glUniform3f(at, v.x, v.y, v.z); };
  glUniformMatrix4fv(program.view_projection, 1, GL_FALSE, glm::value_ptr(view_projection_));
  set(program.eye, list.camera.position_m);
  set(program.key_direction, list.key.direction);
  set(program.key_color, list.key.color);
  set(program.fill_direction, list.fill.direction);
  set(program.fill_color, list.fill.color);
  set(program.rim_direction, list.rim.direction);
  set(program.rim_color, list.rim.color);
  set(program.ambient_up, list.ambient_up);
  set(program.ambient_down, list.ambient_down);
}

void GlesRenderer::draw_item(const scene::DrawList& list, const scene::DrawItem& item, Pass pass) {
  const pack::Material& material = pack_.materials[item.material];
  Program& program = programs_.scene(material, list.shading, pass);
  if (program.name == 0) return;
  use(program, list);
  const auto bone_rows = static_cast<GLsizei>(3 * item.bone_count);
  if (bone_rows > 0) glUniform4fv(program.bones, bone_rows, &list.bones[item.first_bone].row[0].x);
  glUniform4fv(program.tint, 1, material.tint);
  const bool two_sided = (material.flags & pack::kTwoSided) != 0;
  glUniform4f(program.surface, material.gloss, material.shininess, two_sided ? 1.0f : 0.0f, 0.0f);
  if (two_sided)
    glDisable(GL_CULL_FACE);
  else
    glEnable(GL_CULL_FACE);
  if (program.wrinkles >= 0) {
    glUniform4fv(program.wrinkles, 1, list.wrinkles.left.data());
    glUniform4fv(program.wrinkles + 1, 1, list.wrinkles.right.data());
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, textures_.name(material.detail));
    glActiveTexture(GL_TEXTURE0);
  }
  glBindTexture(GL_TEXTURE_2D, textures_.name(material.texture));
  cost_.uploaded_bytes += meshes_[item.object].bind(frame_ % kBufferSets, list.meshes[item.object]);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * item.triangle_count), GL_UNSIGNED_SHORT,
                 nullptr);
  ++cost_.draw_calls;
  cost_.triangles += item.triangle_count;
}

void GlesRenderer::draw_items(const scene::DrawList& list, Pass pass) {
  for (const scene::DrawItem& item : list.items) {
    if (!item_is_valid(list, pack_, item)) {
      all_valid_ = false;
      continue;
    }
    if (item.triangle_count > 0 && needs_pass(pack_.materials[item.material], pass))
      draw_item(list, item, pass);
  }
}

void GlesRenderer::draw_background(const scene::DrawList& list) {
  bind_quad();
  const Vec3 top = to_srgb(list.background_top), bottom = to_srgb(list.background_bottom);
  const GLuint program = programs_.background();
  glUseProgram(program);
  glUniform3f(glGetUniformLocation(program, "u_top"), top.x, top.y, top.z);
  glUniform3f(glGetUniformLocation(program, "u_bottom"), bottom.x, bottom.y, bottom.z);
  const auto axis = [&](int row) {
    const float v = list.camera.projection[0][row];
    return v > 0.0f ? 1.0f : (v < 0.0f ? -1.0f : 0.0f);
  };
  glUniform2f(glGetUniformLocation(program, "u_right"), axis(0), axis(1));
  glDisable(GL_CULL_FACE);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void GlesRenderer::draw_floor_shadows(const scene::DrawList& list) {
  const GLuint program = programs_.floor_shadow();
  glUseProgram(program);
  glUniformMatrix4fv(glGetUniformLocation(program, "u_view_projection"), 1, GL_FALSE,
                     glm::value_ptr(view_projection_));
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  for (const scene::FloorShadow& shadow : list.floor_shadows) {
    const Vec3 c = shadow.center_m;
    glUniform3f(glGetUniformLocation(program, "u_center"), c.x, c.y, c.z);
    glUniform2f(glGetUniformLocation(program, "u_half"), shadow.half_width_m, shadow.half_depth_m);
    glUniform1f(glGetUniformLocation(program, "u_strength"), shadow.strength);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glDisable(GL_BLEND);
}

// At full resolution, whatever the scene's.
void GlesRenderer::draw_overlay(const scene::Overlay& overlay) {
  if (overlay.quads.empty()) return;
  target_.bind_final();
  cost_.uploaded_bytes += overlay_.draw(overlay, programs_.overlay(), width(), height());
  ++cost_.draw_calls;
  cost_.triangles += 2 * static_cast<std::uint32_t>(overlay.quads.size());
  set_attributes(false);
}

Status GlesRenderer::draw(const scene::DrawList& list) {
  ++frame_;
  cost_ = {};
  all_valid_ = true;
  for (const scene::MeshPatch& patch : list.patches)
    if (patch.object < pack_.objects.size()) meshes_[patch.object].add_patch(patch);
  view_projection_ = list.camera.projection * list.camera.view;
  target_.begin(list.render_scale);
  glActiveTexture(GL_TEXTURE0);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  set_attributes(true);
  draw_items(list, Pass::opaque);
  draw_items(list, Pass::core);
  glDepthMask(GL_FALSE);
  draw_background(list);
  draw_floor_shadows(list);
  set_attributes(true);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  draw_items(list, Pass::edge);
  glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
  draw_items(list, Pass::glint);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  set_attributes(false);
  target_.finish(programs_.quad(), quad_buffer_);
  draw_overlay(list.overlay);
  if (context_lost()) return fail(RenderFault::lost, Code::device_lost);
  return all_valid_ ? Status{} : fail(RenderFault::draw_list, Code::invalid_argument);
}

Status GlesRenderer::read_back(std::span<std::uint8_t> out_rgb) {
  const std::size_t w = width(), h = height();
  if (out_rgb.size() < 3 * w * h) return fail(RenderFault::read_back, Code::out_of_capacity);
  target_.bind_final();
  std::array<std::uint8_t, std::size_t{4} * 4096> row{};
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  for (std::size_t y = 0; y < h; ++y) {
    glReadPixels(0, static_cast<GLint>(h - 1 - y), static_cast<GLsizei>(w), 1, GL_RGBA,
                 GL_UNSIGNED_BYTE, row.data());
    std::uint8_t* out = out_rgb.data() + 3 * w * y;
    for (std::size_t x = 0; x < w; ++x) std::copy_n(&row[4 * x], 3, out + 3 * x);
  }
  if (context_lost()) return fail(RenderFault::lost, Code::device_lost);
  return {};
}

}  // namespace
}  // namespace gles

Status open_gles_renderer(const pack::View& pack, bool base_only, const RenderOptions& options,
                          std::unique_ptr<Renderer>& out, ErrorLine& out_error) {
  out.reset();
  auto renderer = std::make_unique<gles::GlesRenderer>(pack, options);
  CARYATID_TRY(renderer->open(base_only, out_error));
  out = std::move(renderer);
  return {};
}

}  // namespace caryatid::platform
