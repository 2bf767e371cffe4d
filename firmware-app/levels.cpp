#include "firmware-app/levels.h"

#include <algorithm>
#include <charconv>

#include "core/scene/compose.h"

namespace caryatid::app {
namespace {

constexpr std::array<const char*, 8> kRoleNames = {"head", "body",  "hair", "clothes",
                                                   "eye",  "mouth", "brow", "lash"};

// The author's weights: a face is looked at, a shoe is not.
float role_importance(pack::ObjectRole role) {
  switch (role) {
    case pack::ObjectRole::head:
    case pack::ObjectRole::eye:
      return 1.0f;
    case pack::ObjectRole::mouth:
    case pack::ObjectRole::brow:
    case pack::ObjectRole::lash:
      return 0.8f;
    case pack::ObjectRole::hair:
      return 0.6f;
    case pack::ObjectRole::body:
      return 0.4f;
    case pack::ObjectRole::clothes:
      return 0.3f;
  }
  return 0.3f;
}

bool face_moves(pack::ObjectRole role) {
  return role != pack::ObjectRole::hair && role != pack::ObjectRole::body &&
         role != pack::ObjectRole::clothes;
}

// A covered pixel costs more fragments in hair, whose layers lie over each other and are drawn
// twice.
float overdraw(pack::ObjectRole role) { return role == pack::ObjectRole::hair ? 3.0f : 1.2f; }

// How much of its bounding sphere's picture an object fills.
constexpr float kSphereFill = 0.45f;

scene::ComposeJob job_of(const agent::Person& person, const scene::DrawList& list) {
  scene::ComposeJob job;
  job.pack = &person.view();
  job.meshes = person.meshes();
  job.joints = person.joints();
  job.camera = list.camera;
  return job;
}

// Shares `total` among the objects that `chosen` accepts, by their size.
template <class Chosen>
void share(std::uint32_t total, const pack::View& pack, std::span<std::uint32_t> out,
           Chosen chosen) {
  std::uint64_t sum = 0;
  for (const pack::Object& o : pack.objects)
    if (chosen(o)) sum += o.max_triangle_count;
  for (std::size_t i = 0; i < pack.objects.size(); ++i)
    if (chosen(pack.objects[i]) && sum > 0)
      out[i] = static_cast<std::uint32_t>(std::uint64_t{total} *
                                          pack.objects[i].max_triangle_count / sum);
}

bool number(std::string_view text, std::uint32_t* out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *out);
  return error == std::errc{} && end == text.data() + text.size() && !text.empty();
}

}  // namespace

bool parse_levels(const std::string& text, const pack::View& pack, std::span<std::uint32_t> out,
                  std::string* out_error) {
  if (text == "auto") return true;
  for (std::size_t i = 0; i < pack.objects.size(); ++i) out[i] = pack.objects[i].max_triangle_count;
  std::uint32_t total = 0;
  if (number(text, &total)) {
    share(total, pack, out, [](const pack::Object&) { return true; });
    return true;
  }
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view item = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(item.size() + 1, rest.size()));
    const std::size_t equals = std::min(item.find('='), item.size());
    const auto role = std::find(kRoleNames.begin(), kRoleNames.end(), item.substr(0, equals));
    if (role == kRoleNames.end() ||
        !number(item.substr(std::min(equals + 1, item.size())), &total)) {
      *out_error = "--lod " + text +
                   ": wanted auto, a number, or OBJECT=NUMBER,... with head, body, "
                   "hair, clothes, eye, mouth, brow, lash";
      return false;
    }
    const auto wanted = static_cast<pack::ObjectRole>(role - kRoleNames.begin());
    share(total, pack, out, [wanted](const pack::Object& o) { return o.role == wanted; });
  }
  return true;
}

lod::ObjectNeed object_need(const pack::Object& object, const scene::DrawList& last,
                            const agent::Person& person, std::size_t index, std::uint32_t width,
                            std::uint32_t height, bool expressive) {
  const scene::Importance seen = scene::importance(job_of(person, last), index, width, height);
  lod::ObjectNeed need;
  need.min_triangles = object.base_triangle_count;
  need.max_triangles = object.max_triangle_count;
  need.screen_px = kSphereFill * seen.screen_px;
  need.overdraw = overdraw(object.role);
  need.axis_closeness = seen.axis_closeness;
  need.expression = face_moves(object.role) ? (expressive ? 1.0f : 0.5f) : 0.1f;
  need.importance = role_importance(object.role);
  need.deformed_per_triangle = face_moves(object.role) ? 0.55f : 0.0f;
  return need;
}

float shaded_pixels(const agent::Person& person, const scene::DrawList& list, std::uint32_t width,
                    std::uint32_t height) {
  const scene::ComposeJob job = job_of(person, list);
  // Without the background: it goes with the target's pixels, and the controller plans with the
  // objects' fragments alone, so counting it here would make every prediction too low.
  float sum = 0.0f;
  for (std::size_t o = 0; o < person.object_count(); ++o)
    sum += kSphereFill * scene::importance(job, o, width, height).screen_px *
           overdraw(person.view().objects[o].role);
  return sum;
}

}  // namespace caryatid::app
