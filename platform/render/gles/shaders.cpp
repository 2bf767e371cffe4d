#include "platform/render/gles/shaders.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "platform/render/gles/shader_text.h"

namespace caryatid::platform::gles {
namespace {

void set_error(ErrorLine& out, const char* what, const char* log) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(), "a shader %s: %s", what, log);
  line[std::strcspn(line.data(), "\n")] = '\0';
  out.assign({line.data(), std::strlen(line.data())});
}

struct Source {
  std::array<const char*, 4> part{};
};

GLuint compile(GLenum type, const Source& source, ErrorLine& out_error) {
  const GLuint shader = glCreateShader(type);
  glShaderSource(shader, static_cast<GLsizei>(source.part.size()), source.part.data(), nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::array<char, 200> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  set_error(out_error, "does not compile", log.data());
  glDeleteShader(shader);
  return 0;
}

GLuint link(const Source& vertex, const Source& fragment, ErrorLine& out_error) {
  const GLuint v = compile(GL_VERTEX_SHADER, vertex, out_error);
  const GLuint f = v != 0 ? compile(GL_FRAGMENT_SHADER, fragment, out_error) : 0;
  if (f == 0) {
    glDeleteShader(v);
    return 0;
  }
  const GLuint program = glCreateProgram();
  glAttachShader(program, v);
  glAttachShader(program, f);
  constexpr const char* kNames[kAttributeCount] = {"a_position", "a_normal", "a_uv", "a_bone",
                                                   "a_weight"};
  for (GLuint i = 0; i < kAttributeCount; ++i) glBindAttribLocation(program, i, kNames[i]);
  glLinkProgram(program);
  glDeleteShader(v);
  glDeleteShader(f);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == GL_TRUE) {
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "u_texture"), 0);
    glUniform1i(glGetUniformLocation(program, "u_detail"), 1);
    return program;
  }
  std::array<char, 200> log{};
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  set_error(out_error, "does not link", log.data());
  glDeleteProgram(program);
  return 0;
}

void find_uniforms(Program& p) {
  const auto at = [&p](const char* name) { return glGetUniformLocation(p.name, name); };
  p.bones = at("u_bones");
  p.view_projection = at("u_view_projection");
  p.eye = at("u_eye");
  p.key_direction = at("u_key_direction");
  p.key_color = at("u_key_color");
  p.fill_direction = at("u_fill_direction");
  p.fill_color = at("u_fill_color");
  p.rim_direction = at("u_rim_direction");
  p.rim_color = at("u_rim_color");
  p.ambient_up = at("u_ambient_up");
  p.ambient_down = at("u_ambient_down");
  p.tint = at("u_tint");
  p.surface = at("u_surface");
  p.wrinkles = at("u_wrinkles");
}

// Where light() runs: with the fragments in the best tier, with the vertices below it.
bool make_scene_program(std::size_t kind, std::size_t tier, std::size_t pass, Program& out,
                        ErrorLine& out_error) {
  const bool lined = kind == kLinedSkin;
  const auto shown = lined ? static_cast<std::size_t>(pack::MaterialKind::skin) : kind;
  std::array<char, 80> defines{};
  std::snprintf(defines.data(), defines.size(),
                "#define KIND %d\n#define TIER %d\n#define PASS %d\n#define LINES %d\n",
                static_cast<int>(shown), static_cast<int>(tier), static_cast<int>(pass),
                lined && tier > 0 ? 1 : 0);
  const bool per_pixel = tier == static_cast<std::size_t>(scene::Shading::per_pixel);
  const char* vertex_light = per_pixel ? "" : kLightText;
  const char* fragment_light = per_pixel ? kLightText : "";
  out.name = link({{defines.data(), kVertexText, vertex_light, kVertexMain}},
                  {{defines.data(), kFragmentText, fragment_light, kFragmentMain}}, out_error);
  if (out.name == 0) return false;
  find_uniforms(out);
  return true;
}

}  // namespace

std::size_t program_kind(const pack::Material& material) {
  if (material.kind == pack::MaterialKind::skin && material.detail != pack::kNoTexture)
    return kLinedSkin;
  return std::min(static_cast<std::size_t>(material.kind), kLinedSkin - 1);
}

bool needs_pass(const pack::Material& material, Pass pass) {
  if ((material.flags & pack::kCornea) != 0) return pass == Pass::glint;
  if ((material.flags & pack::kAlphaBlend) != 0) {
    const bool flat = material.kind == pack::MaterialKind::lash;
    return pass == Pass::edge || (pass == Pass::core && !flat);
  }
  return pass == Pass::opaque;
}

Programs::~Programs() {
  for (auto& kind : scene_)
    for (auto& tier : kind)
      for (Program& program : tier) glDeleteProgram(program.name);
  glDeleteProgram(quad_);
  glDeleteProgram(background_);
  glDeleteProgram(floor_shadow_);
  glDeleteProgram(overlay_);
}

GLuint Programs::make(const char* vertex, const char* fragment, ErrorLine& out_error) {
  return link({{vertex, "", "", ""}}, {{fragment, "", "", ""}}, out_error);
}

Status Programs::create(const pack::View& pack, ErrorLine& out_error) {
  for (const pack::Material& material : pack.materials) {
    const std::size_t kind = program_kind(material);
    for (std::size_t pass = 0; pass < kPassCount; ++pass) {
      if (!needs_pass(material, static_cast<Pass>(pass))) continue;
      for (std::size_t tier = 0; tier < kTierCount; ++tier) {
        Program& program = scene_[kind][tier][pass];
        if (program.name == 0 && !make_scene_program(kind, tier, pass, program, out_error))
          return fail(RenderFault::program);
      }
    }
  }
  quad_ = make(kQuadVertex, kQuadFragment, out_error);
  background_ = make(kBackgroundVertex, kBackgroundFragment, out_error);
  floor_shadow_ = make(kFloorShadowVertex, kFloorShadowFragment, out_error);
  overlay_ = make(kOverlayVertex, kOverlayFragment, out_error);
  const bool all = quad_ != 0 && background_ != 0 && floor_shadow_ != 0 && overlay_ != 0;
  return all ? Status{} : fail(RenderFault::program);
}

}  // namespace caryatid::platform::gles
