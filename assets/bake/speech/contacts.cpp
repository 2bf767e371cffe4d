#include "assets/bake/speech/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "core/face/mixer.h"
#include "core/speech/mouth.h"

namespace caryatid::bake {
namespace {

using speech::Contact;

constexpr double kFrame_s = 1.0 / 30.0;

// Ericson, Real-Time Collision Detection (2005), 5.1.5, as a distance.
float distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return glm::length(ap);
  const Vec3 bp = p - b;
  const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return glm::length(bp);
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::length(p - (a + d1 / (d1 - d3) * ab));
  const Vec3 cp = p - c;
  const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return glm::length(cp);
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::length(p - (a + d2 / (d2 - d6) * ac));
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return glm::length(p - (b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)));
  const float sum = va + vb + vc;
  return glm::length(p - (a + vb / sum * ab + vc / sum * ac));
}

// The mouth of a person in the frame that was shown last.
class Lips {
 public:
  explicit Lips(agent::Person* person) : person_(*person) {
    std::vector<std::uint32_t> finest;
    for (const pack::Object& o : person_.view().objects) finest.push_back(o.max_triangle_count);
    person_.set_levels(finest);
    person_.show(person_.rest_face(), body::BapFrame{}, Affine{}, 0.0f);  // Turns no head.
    const pack::View& view = person_.view();
    for (std::size_t o = 0; o < person_.object_count(); ++o)
      if (view.objects[o].role == pack::ObjectRole::head) head_ = o;
    const Vec3 lower = point(2, 3);
    find_incisors();
    const scene::MeshView& mesh = person_.meshes()[head_];
    for (std::size_t i = 0; i < 3 * std::size_t{mesh.triangle_count}; i += 3) {
      Vec3 middle{0};
      for (std::size_t k = 0; k < 3; ++k) middle += at(mesh.indices[i + k]) / 3.0f;
      // At rest the lower lip is what lies below its inner contour, near the mid-line.
      if (std::abs(middle.x - lower.x) < 0.012f && middle.y < lower.y + 2e-4f &&
          middle.y > lower.y - 0.015f && middle.z > lower.z - 0.02f)
        lower_lip_.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    }
    if (lower_lip_.empty()) throw std::runtime_error("this person has no lower lip to measure");
  }

  // The widest opening between the inner contours: middle and both quarters.
  float gap_m() const {
    float gap = point(2, 2).y - point(2, 3).y;
    gap = std::max(gap, point(2, 7).y - point(2, 9).y);
    return std::max(gap, point(2, 6).y - point(2, 8).y);
  }
  // From the edges of the two middle upper incisors to the nearest skin of the lower lip.
  float teeth_m() const {
    float least = 1.0f;
    for (const Vec3 edge : incisor_edges_)
      for (const auto& t : lower_lip_)
        least = std::min(least, distance_to_triangle(edge, at(t[0]), at(t[1]), at(t[2])));
    return least;
  }

 private:
  // Upper teeth hang on the skull and stay where they are.
  void find_incisors() {
    const pack::FeaturePoint* p = pack::find_feature_point(person_.view(), 9, 10);
    if (p == nullptr) return;  // The built-in face has none: nothing is ever met there.
    const Vec3 edge = point(9, 10);
    incisor_edges_.push_back(edge);
    if (p->object == pack::kNoObject) return;
    const scene::MeshView& teeth = person_.meshes()[p->object];
    for (std::uint32_t v = 0; v < teeth.vertex_count; ++v) {
      const Vec3 d = glm::abs(Vec3(teeth.dynamic[v].position_m) - edge);
      if (d.x < 0.006f && d.y < 0.0008f && d.z < 0.003f)
        incisor_edges_.push_back(teeth.dynamic[v].position_m);
    }
  }
  Vec3 point(int group, int index) const { return person_.feature_point_m(group, index); }
  Vec3 at(std::uint16_t vertex) const { return person_.meshes()[head_].dynamic[vertex].position_m; }

  agent::Person& person_;
  std::size_t head_ = 0;
  std::vector<Vec3> incisor_edges_;
  std::vector<std::array<std::uint16_t, 3>> lower_lip_;
};

struct Shown {
  double time_s;
  float gap_m, teeth_m;
};

// Only frames in which a contact is due are posed.
bool is_due(std::span<const TimedPhone> phones, double time_s) {
  const auto next = std::upper_bound(phones.begin(), phones.end(), time_s - 0.3,
                                     [](double t, const TimedPhone& p) { return t < p.start_s; });
  for (auto p = next == phones.begin() ? next : next - 1;
       p != phones.end() && p->start_s < time_s + 0.1; ++p) {
    const Contact c = speech::phoneme_of(p->ipa).begins.contact;
    if (c == Contact::lips || c == Contact::lip_teeth) return true;
  }
  return false;
}

std::vector<Shown> show(std::span<const TimedPhone> phones, double end_s,
                        const face::FapFrame& mood, const speech::Mouth& mouth,
                        agent::Person* person) {
  Lips lips(person);
  auto utterance = std::make_unique<speech::Utterance>();
  std::vector<Shown> out;
  std::size_t next = 0;
  for (double t = 0.0; t < end_s; t += kFrame_s) {
    for (; next < phones.size() && utterance->has_room(); ++next)
      (void)utterance->add_phone(static_cast<std::int32_t>(phones[next].start_s * 1000.0),
                                 speech::phoneme_of(phones[next].ipa));
    utterance->forget_before(static_cast<std::int32_t>(t * 1000.0) - 1000);
    if (!is_due(phones, t)) continue;
    const auto m =
        mouth.at(*utterance, static_cast<float>(t * 1000.0), static_cast<float>(kFrame_s * 1000.0));
    face::MixJob mix;
    mix.rest = &person->rest_face();
    mix.emotion = &mood;
    mix.speech = &m.faps;
    mix.speech_strength = m.strength;
    mix.limits = &person->limits();
    face::FapFrame shown = mix.run();
    // The mesh is measured where it was made; teeth are told where the skull has turned them.
    for (const int fap : {48, 49, 50}) shown.set(fap, 0.0f);
    person->show(shown, body::BapFrame{}, Affine{}, 0.0f);
    out.push_back({t, lips.gap_m(), lips.teeth_m()});
  }
  return out;
}

}  // namespace

ContactReport measure_contacts(std::span<const TimedPhone> phones, double end_s,
                               const face::FapFrame& mood, agent::Person* person,
                               const speech::Mouth& mouth) {
  const std::vector<Shown> shown = show(phones, end_s, mood, mouth, person);
  ContactReport out;
  for (std::size_t i = 0; i < phones.size(); ++i) {
    const Contact contact = speech::phoneme_of(phones[i].ipa).begins.contact;
    if (contact != Contact::lips && contact != Contact::lip_teeth) continue;
    const double from_s = phones[i].start_s - 0.045;
    const double to_s = (i + 1 < phones.size() ? phones[i + 1].start_s : end_s) + 0.015;
    float gap_m = 1.0f, teeth_m = 1.0f;
    for (const Shown& s : shown) {
      if (s.time_s < from_s || s.time_s > to_s) continue;
      gap_m = std::min(gap_m, s.gap_m);
      teeth_m = std::min(teeth_m, s.teeth_m);
    }
    if (contact == Contact::lips) {
      ++out.bilabials;
      out.shut += gap_m <= kLipsMeet_m;
      out.widest_gap_m = std::max(out.widest_gap_m, gap_m);
    } else {
      ++out.labiodentals;
      out.touching += teeth_m <= kTeethMet_m;
      out.farthest_teeth_m = std::max(out.farthest_teeth_m, teeth_m);
    }
  }
  return out;
}

}  // namespace caryatid::bake
