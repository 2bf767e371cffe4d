#include "platform/render/gles/buffers.h"

#include <algorithm>
#include <cstddef>

#include "platform/render/gles/shaders.h"

namespace caryatid::platform::gles {
namespace {

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

scene::DirtyRange join(scene::DirtyRange a, scene::DirtyRange b) {
  if (a.count == 0) return b;
  if (b.count == 0) return a;
  const std::uint32_t first = std::min(a.first, b.first);
  return {first, std::max(a.first + a.count, b.first + b.count) - first};
}

}  // namespace

void Stream::create(GLenum target, std::uint32_t capacity, std::uint32_t element_bytes) {
  target_ = target;
  element_bytes_ = element_bytes;
  glGenBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  for (const GLuint buffer : buffers_) {
    glBindBuffer(target_, buffer);
    const auto bytes = static_cast<GLsizeiptr>(std::size_t{capacity} * element_bytes);
    glBufferData(target_, bytes, nullptr, GL_DYNAMIC_DRAW);
  }
  pending_.fill({0, capacity});
}

void Stream::add_dirty(scene::DirtyRange range) {
  for (scene::DirtyRange& pending : pending_) pending = join(pending, range);
}

std::uint32_t Stream::bind(std::size_t set, const void* data, std::uint32_t live_count) {
  glBindBuffer(target_, buffers_[set]);
  const scene::DirtyRange range = pending_[set].clipped(live_count);
  pending_[set] = {};
  if (range.count == 0) return 0;
  const std::size_t first = std::size_t{range.first} * element_bytes_;
  const std::size_t bytes = std::size_t{range.count} * element_bytes_;
  glBufferSubData(target_, static_cast<GLintptr>(first), static_cast<GLsizeiptr>(bytes),
                  static_cast<const std::byte*>(data) + first);
  return static_cast<std::uint32_t>(bytes);
}

void MeshBuffers::create(const pack::Object& object) {
  dynamic_.create(GL_ARRAY_BUFFER, object.max_vertex_count, sizeof(scene::DynamicVertex));
  fixed_.create(GL_ARRAY_BUFFER, object.max_vertex_count, sizeof(scene::StaticVertex));
  indices_.create(GL_ELEMENT_ARRAY_BUFFER, 3 * object.max_triangle_count, sizeof(std::uint16_t));
}

void MeshBuffers::add_patch(const scene::MeshPatch& patch) {
  dynamic_.add_dirty(patch.dynamic);
  fixed_.add_dirty(patch.fixed);
  indices_.add_dirty(patch.indices);
}

std::uint32_t MeshBuffers::bind(std::size_t set, const scene::MeshView& mesh) {
  std::uint32_t bytes = dynamic_.bind(set, mesh.dynamic.data(), mesh.vertex_count);
  const GLsizei dynamic_stride = sizeof(scene::DynamicVertex);
  glVertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, dynamic_stride,
                        offset(offsetof(scene::DynamicVertex, position_m)));
  glVertexAttribPointer(kNormal, 4, GL_BYTE, GL_TRUE, dynamic_stride,
                        offset(offsetof(scene::DynamicVertex, normal)));
  bytes += fixed_.bind(set, mesh.fixed.data(), mesh.vertex_count);
  const GLsizei fixed_stride = sizeof(scene::StaticVertex);
  glVertexAttribPointer(kUv, 2, GL_UNSIGNED_SHORT, GL_TRUE, fixed_stride,
                        offset(offsetof(scene::StaticVertex, uv)));
  glVertexAttribPointer(kBone, 4, GL_UNSIGNED_BYTE, GL_FALSE, fixed_stride,
                        offset(offsetof(scene::StaticVertex, bone)));
  glVertexAttribPointer(kWeight, 4, GL_UNSIGNED_BYTE, GL_TRUE, fixed_stride,
                        offset(offsetof(scene::StaticVertex, weight)));
  return bytes + indices_.bind(set, mesh.indices.data(), 3 * mesh.triangle_count);
}

}  // namespace caryatid::platform::gles
