// Packs: any bytes, in pieces of any size, are refused or shown; nothing outside their image is
// read, and what the loader lets through can be started, refined, posed and drawn.
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "core/agent/person.h"
#include "core/base/crc.h"
#include "core/scene/compose.h"

namespace {

// Seals what a fuzzer changed: without true CRCs nothing behind the first check would be reached.
void seal(std::vector<std::byte>& file) {
  using namespace caryatid;
  pack::PackHeader h;
  if (file.size() < sizeof h) return;
  std::memcpy(&h, file.data(), sizeof h);
  const std::size_t sections = h.section_count * sizeof(pack::Section);
  const std::size_t chunks = h.chunk_count * sizeof(pack::Chunk);
  if (h.section_count <= pack::kMaxSections && h.chunk_count <= pack::kMaxChunks &&
      file.size() >= sizeof h + sections + chunks) {
    std::size_t at = sizeof h + sections + chunks;
    for (std::uint32_t c = 0; c < h.chunk_count; ++c) {
      std::byte* entry = file.data() + sizeof h + sections + c * sizeof(pack::Chunk);
      pack::Chunk chunk;
      std::memcpy(&chunk, entry, sizeof chunk);
      if (chunk.bytes > file.size() - at) break;
      chunk.crc = crc32c(std::span(file).subspan(at, chunk.bytes));
      std::memcpy(entry, &chunk, sizeof chunk);
      at += chunk.bytes;
    }
    h.tables_crc = crc32c(std::span(file).subspan(sizeof h, sections + chunks));
  }
  h.header_crc = crc32c(std::as_bytes(std::span(&h, 1)).first(60));
  std::memcpy(file.data(), &h, sizeof h);
}

void show(const caryatid::pack::Loader& loader) {
  using namespace caryatid;
  const std::size_t bytes = agent::Person::arena_bytes(loader.view());
  if (bytes > (32u << 20)) return;
  std::vector<Vec4> memory(bytes / sizeof(Vec4) + 1);
  Arena arena(std::as_writable_bytes(std::span(memory)));
  const auto person = std::make_unique<agent::Person>();
  if (!person->start(loader.view(), arena).ok()) return;
  (void)person->refine(loader);
  std::vector<std::uint32_t> all(person->object_count(), 0xFFFFFFFFu);
  person->set_levels(all);
  face::FapFrame faps;
  for (int fap = 3; fap <= face::kFapCount; ++fap) faps.set(fap, 300.0f);
  person->show(faps, {}, Affine{}, 0.03f);
  const auto list = std::make_unique<scene::DrawList>();
  scene::ComposeJob job;
  job.pack = &person->view();
  job.meshes = person->meshes();
  job.joints = person->joints();
  (void)job.run(list.get());
  person->collect_patches(&list->patches);
  // Every index that would reach a GPU lies inside its buffer.
  for (const scene::MeshView& m : person->meshes())
    for (std::uint32_t i = 0; i < 3 * m.triangle_count; ++i)
      if (m.indices[i] >= m.vertex_count) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace caryatid;
  if (size < 2 || size > (1u << 20)) return 0;
  std::vector<std::byte> file(size - 2);
  if (!file.empty()) std::memcpy(file.data(), data + 2, file.size());
  if ((data[0] & 1) != 0) seal(file);
  const Result<pack::PackHeader> header = pack::read_header(file);
  if (!header.ok() || header.value.image_bytes > (8u << 20)) return 0;
  std::vector<Vec4> image(header.value.image_bytes / sizeof(Vec4) + 1);
  const auto loader = std::make_unique<pack::Loader>();
  if (!loader->begin(header.value, std::as_writable_bytes(std::span(image))).ok()) return 0;
  const std::size_t piece = data[1] * 64u + 1u;
  for (std::size_t at = sizeof(pack::PackHeader); at < file.size(); at += piece)
    if (!loader->feed(std::span(file).subspan(at, std::min(piece, file.size() - at))).ok()) break;
  (void)loader->end();
  if (loader->base_ready()) show(*loader);
  return 0;
}
