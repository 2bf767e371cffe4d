#include "core/pack/view.h"

#include <cmath>
#include <cstring>

#include "core/pack/loader.h"

namespace caryatid::pack {
namespace {

constexpr Status refused(Refusal why) {
  return {Code::corrupt_data, static_cast<std::uint16_t>(why)};
}

bool within(std::uint32_t first, std::uint32_t count, std::size_t size) {
  return first <= size && count <= size - first;
}

bool finite(const float* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) return false;
  return true;
}

bool power_of_two(std::uint32_t n) { return n != 0 && (n & (n - 1)) == 0; }

Status check_character(const View& view) {
  const Character& c = *view.character;
  if (std::memchr(c.name, '\0', sizeof c.name) == nullptr) return refused(Refusal::bad_number);
  const float facts[] = {c.iris_diameter_m, c.eye_separation_m, c.eye_nose_m,  c.mouth_nose_m,
                         c.mouth_width_m,   c.stature_m,        c.leg_length_m};
  for (const float f : facts)
    if (!std::isfinite(f) || f <= 0.0f || f > 10.0f) return refused(Refusal::bad_number);
  return finite(view.rest_face.data(), view.rest_face.size()) ? Status{}
                                                              : refused(Refusal::bad_number);
}

Status check_joints(const View& view) {
  if (view.joints.size() > kMaxJoints) return refused(Refusal::bad_joint);
  for (std::size_t j = 0; j < view.joints.size(); ++j) {
    const Joint& joint = view.joints[j];
    if (joint.parent != kNoJoint && joint.parent >= j) return refused(Refusal::bad_joint);
    if (!finite(joint.center_m, 3)) return refused(Refusal::bad_number);
  }
  return {};
}

Status check_materials(const View& view) {
  if (view.materials.size() > kMaxMaterials) return refused(Refusal::bad_material);
  for (const Material& m : view.materials) {
    const bool texture_ok = m.texture == kNoTexture || m.texture < view.textures.size();
    const bool detail_ok = m.detail == kNoTexture || m.detail < view.textures.size();
    if (m.kind > MaterialKind::lash || !texture_ok || !detail_ok || !finite(m.tint, 4) ||
        !std::isfinite(m.gloss) || !std::isfinite(m.shininess))
      return refused(Refusal::bad_material);
  }
  return {};
}

// Bytes of the mip levels from `first` to the last of a texture.
std::uint32_t mip_bytes(const Texture& t, std::uint32_t first) {
  std::uint32_t bytes = 0;
  for (std::uint32_t level = first; level < t.level_count; ++level) {
    const std::uint32_t w =
        t.width >> level > 0 ? static_cast<std::uint32_t>(t.width >> level) : 1u;
    const std::uint32_t h =
        t.height >> level > 0 ? static_cast<std::uint32_t>(t.height >> level) : 1u;
    bytes += t.format == TextureFormat::etc1 ? ((w + 3) / 4) * ((h + 3) / 4) * 8 : w * h * 2;
  }
  return bytes;
}

Status check_textures(const View& view) {
  if (view.textures.size() > kMaxTextures) return refused(Refusal::bad_texture);
  for (const Texture& t : view.textures) {
    if (!power_of_two(t.width) || !power_of_two(t.height) || t.width > 1024 || t.height > 1024 ||
        t.format > TextureFormat::etc1 || t.level_count == 0 || t.level_count > 11 ||
        t.base_level >= t.level_count ||
        !within(t.texel_offset, t.texel_bytes, view.texels.size()) ||
        t.texel_bytes != mip_bytes(t, 0))
      return refused(Refusal::bad_texture);
  }
  return {};
}

Status check_base_mesh(const View& view, const Object& o) {
  for (std::uint32_t i = 0; i < 3 * o.base_triangle_count; ++i)
    if (view.base_indices[o.first_base_index + i] >= o.base_vertex_count)
      return refused(Refusal::bad_index);
  for (std::uint32_t v = 0; v < o.base_vertex_count; ++v) {
    const Vertex& vertex = view.versions[o.first_version + v];
    if (!finite(vertex.position_m, 3)) return refused(Refusal::bad_number);
    for (const std::uint8_t bone : vertex.bone)
      if (bone >= o.bone_count) return refused(Refusal::bad_object);
  }
  return {};
}

Status check_objects(const View& view) {
  if (view.objects.empty() || view.objects.size() > kMaxObjects)
    return refused(Refusal::bad_object);
  for (const Object& o : view.objects) {
    const bool ok =
        std::memchr(o.name, '\0', sizeof o.name) != nullptr && o.role <= ObjectRole::lash &&
        o.material < view.materials.size() && o.bone_count > 0 &&
        o.bone_count <= kMaxBonesPerDraw &&
        within(o.first_version, o.version_count, view.versions.size()) &&
        o.base_vertex_count <= o.version_count && o.base_vertex_count <= o.max_vertex_count &&
        o.max_vertex_count <= kMaxVerticesPerObject &&
        o.base_triangle_count <= o.max_triangle_count &&
        o.max_triangle_count < 4 * kMaxVerticesPerObject &&
        within(o.first_base_index, 3 * o.base_triangle_count, view.base_indices.size()) &&
        within(o.first_split, o.split_count, view.splits.size()) && finite(o.center_m, 3) &&
        std::isfinite(o.radius_m);
    if (!ok) return refused(Refusal::bad_object);
    for (std::size_t b = 0; b < o.bone_count; ++b)
      if (o.bone[b] >= view.joints.size()) return refused(Refusal::bad_object);
    CARYATID_TRY(check_base_mesh(view, o));
  }
  return {};
}

Status check_fat(const View& view) {
  for (const Channel& c : view.channels) {
    const float limits[] = {c.from, c.to, c.partner_from, c.partner_to};
    if (c.fap > 68 || c.partner > 68 || !finite(limits, 4) || c.from == c.to ||
        (c.partner != 0 && c.partner_from == c.partner_to))
      return refused(Refusal::bad_channel);
  }
  if (view.fat_first.size() != view.versions.size() + 1) return refused(Refusal::bad_move);
  for (const Object& o : view.objects)
    for (std::uint32_t v = o.first_version; v < o.first_version + o.base_vertex_count; ++v) {
      if (view.fat_first[v] > view.fat_first[v + 1] ||
          view.fat_first[v + 1] > view.fat_moves.size())
        return refused(Refusal::bad_move);
      for (std::uint32_t m = view.fat_first[v]; m < view.fat_first[v + 1]; ++m)
        if (view.fat_moves[m].channel >= view.channels.size()) return refused(Refusal::bad_move);
    }
  return {};
}

bool fit_term_ok(const FitTerm& term, std::uint8_t receiver, bool* names_fap) {
  if (!std::isfinite(term.coefficient)) return false;
  for (std::size_t i = 0; i < kFitFactors; ++i) {
    const std::uint8_t fap = term.fap[i], power = term.power[i];
    if (fap == 0 && power == 0) continue;
    if (fap < 3 || fap > 68 || fap == receiver || power < 1 || power > 3) return false;
    *names_fap = true;
  }
  return true;
}

Status check_fit(const View& view) {
  if (view.fit.size() > kMaxFitRules) return refused(Refusal::bad_fit);
  for (const FitRule& rule : view.fit) {
    bool ok = rule.receiver >= 3 && rule.receiver <= 68 && rule.numerator_count >= 1 &&
              rule.numerator_count <= kFitNumerators && rule.denominator_count <= kFitDenominators;
    bool names_fap = false;
    for (std::size_t i = 0; ok && i < rule.numerator_count; ++i)
      ok = fit_term_ok(rule.numerator[i], rule.receiver, &names_fap);
    bool ignored = false;
    for (std::size_t i = 0; ok && i < rule.denominator_count; ++i)
      ok = fit_term_ok(rule.denominator[i], rule.receiver, &ignored);
    if (!ok || !names_fap) return refused(Refusal::bad_fit);
  }
  return {};
}

Status check_feature_points(const View& view) {
  for (const FeaturePoint& p : view.feature_points) {
    const bool ok = p.object == kNoObject ? p.vertex < view.joints.size()
                                          : p.object < view.objects.size() &&
                                                p.vertex < view.objects[p.object].base_vertex_count;
    if (!ok || !finite(p.position_m, 3)) return refused(Refusal::bad_feature_point);
  }
  return {};
}

// The object that a vertex version belongs to; the last one when there is none.
const Object& owner(const View& view, std::uint32_t version) {
  for (const Object& o : view.objects)
    if (version >= o.first_version && version - o.first_version < o.version_count) return o;
  return view.objects.back();
}

Status check_version(const View& view, std::uint32_t index) {
  const Vertex& vertex = view.versions[index];
  if (!finite(vertex.position_m, 3)) return refused(Refusal::bad_number);
  const Object& o = owner(view, index);
  for (const std::uint8_t bone : vertex.bone)
    if (bone >= o.bone_count) return refused(Refusal::bad_object);
  return {};
}

}  // namespace

Status validate_elements(const View& view, SectionId section, std::uint32_t first,
                         std::uint32_t count) {
  for (std::uint32_t i = first; i - first < count; ++i) {
    if (section == SectionId::versions) CARYATID_TRY(check_version(view, i));
    if (section == SectionId::fat_first && view.fat_first[i] > view.fat_moves.size())
      return refused(Refusal::bad_move);
    if (section == SectionId::fat_moves && view.fat_moves[i].channel >= view.channels.size())
      return refused(Refusal::bad_move);
  }
  return {};
}

Status validate_view(const View& view) {
  if (view.character == nullptr || view.joints.empty() || view.rest_face.size() != 69)
    return refused(Refusal::missing_section);
  CARYATID_TRY(check_character(view));
  CARYATID_TRY(check_joints(view));
  CARYATID_TRY(check_materials(view));
  CARYATID_TRY(check_textures(view));
  CARYATID_TRY(check_objects(view));
  CARYATID_TRY(check_fat(view));
  CARYATID_TRY(check_fit(view));
  return check_feature_points(view);
}

std::uint16_t find_object(const View& view, const char* name) {
  for (std::size_t o = 0; o < view.objects.size(); ++o)
    if (std::strncmp(view.objects[o].name, name, sizeof view.objects[o].name) == 0)
      return static_cast<std::uint16_t>(o);
  return kNoObject;
}

const FeaturePoint* find_feature_point(const View& view, int group, int index) {
  for (const FeaturePoint& p : view.feature_points)
    if (p.group == group && p.index == index) return &p;
  return nullptr;
}

}  // namespace caryatid::pack
