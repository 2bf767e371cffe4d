#pragma once
// The vertex and index buffers of one object, three of each: while the GPU reads last frame's, the
// CPU fills the next. A set remembers what changed since it was last filled and takes just that.
#include <array>

#include "platform/render/gles/gl.h"

namespace caryatid::platform::gles {

inline constexpr std::size_t kBufferSets = 3;

// One kind of data in three copies. Element ranges, fixed capacity.
class Stream {
 public:
  Stream() = default;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data()); }

  void create(GLenum target, std::uint32_t capacity, std::uint32_t element_bytes);
  void add_dirty(scene::DirtyRange range);
  // Binds copy `set` and brings it up to date from `data` (live_count elements). Returns bytes.
  std::uint32_t bind(std::size_t set, const void* data, std::uint32_t live_count);

 private:
  GLenum target_ = 0;
  std::uint32_t element_bytes_ = 0;
  std::array<GLuint, kBufferSets> buffers_{};
  std::array<scene::DirtyRange, kBufferSets> pending_{};
};

class MeshBuffers {
 public:
  void create(const pack::Object& object);
  void add_patch(const scene::MeshPatch& patch);
  // Uploads what is pending in this set and sets the five attribute pointers. Returns bytes.
  std::uint32_t bind(std::size_t set, const scene::MeshView& mesh);

 private:
  Stream dynamic_, fixed_, indices_;
};

}  // namespace caryatid::platform::gles
