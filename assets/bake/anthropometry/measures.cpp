#include "assets/bake/anthropometry/measures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "assets/bake/anthropometry/surface_distance.h"

namespace caryatid::bake::anthropometry {
namespace {

constexpr float kDegrees = 57.29577951f;
constexpr const char* kFarkas = "Farkas 1994, North American white adults (recalled, not verified)";
constexpr const char* kAnsur = "ANSUR II 2012, adults";
constexpr const char* kNone = "";

// A line of the table. Landmarks are names as in landmarks.h; those with * exist on both sides: one
// of them in a line is measured left and right and averaged, "x* x*" is from left to right.
struct Entry {
  const char* name;
  Kind kind;
  const char* landmarks[5];
  int axis;  // Axial: 0 x, 1 y, 2 z.
  Norm men, women;
  const char* source;
};

constexpr Entry kEntries[] = {
    {"face width zy-zy",
     Kind::straight,
     {"zy l", "zy r"},
     0,
     {139.1f, 5.3f},
     {130.0f, 4.6f},
     kFarkas},
    {"jaw width go-go",
     Kind::straight,
     {"go l", "go r"},
     0,
     {105.6f, 6.7f},
     {94.5f, 5.0f},
     kFarkas},
    {"forehead width ft-ft", Kind::straight, {"ft l", "ft r"}, 0, {}, {}, kNone},
    {"head breadth eu-eu",
     Kind::straight,
     {"eu l", "eu r"},
     0,
     {154.3f, 5.5f},
     {147.8f, 5.2f},
     kAnsur},
    {"head length g-op", Kind::straight, {"g", "op"}, 0, {199.5f, 7.0f}, {189.8f, 7.4f}, kAnsur},
    {"face height n-gn", Kind::straight, {"n", "gn"}, 0, {124.7f, 5.7f}, {111.4f, 4.8f}, kFarkas},
    {"sellion-menton se-gn",
     Kind::straight,
     {"se", "gn"},
     0,
     {122.6f, 6.7f},
     {113.1f, 6.1f},
     kAnsur},
    {"upper face n-sto", Kind::straight, {"n", "sto"}, 0, {76.6f, 4.0f}, {69.4f, 3.2f}, kFarkas},
    {"lower face sn-gn", Kind::straight, {"sn", "gn"}, 0, {72.6f, 4.5f}, {64.3f, 4.0f}, kFarkas},
    {"forehead tr-n", Kind::straight, {"tr", "n"}, 0, {67.1f, 7.5f}, {63.0f, 6.0f}, kFarkas},
    {"nose height n-sn", Kind::straight, {"n", "sn"}, 0, {54.8f, 3.3f}, {50.6f, 3.1f}, kFarkas},
    {"nose depth sn-prn", Kind::straight, {"sn", "prn"}, 0, {19.5f, 1.9f}, {19.7f, 1.6f}, kFarkas},
    {"nose width al-al",
     Kind::straight,
     {"al l", "al r"},
     0,
     {34.9f, 2.1f},
     {31.4f, 2.0f},
     kFarkas},
    {"inner eyes en-en",
     Kind::straight,
     {"en l", "en r"},
     0,
     {33.3f, 2.7f},
     {31.8f, 2.3f},
     kFarkas},
    {"outer eyes ex-ex",
     Kind::straight,
     {"ex l", "ex r"},
     0,
     {91.2f, 3.0f},
     {87.8f, 3.2f},
     kFarkas},
    {"eye ex-en", Kind::straight, {"ex*", "en*"}, 0, {31.3f, 1.2f}, {30.7f, 1.2f}, kFarkas},
    {"lid opening ps-pi", Kind::straight, {"ps*", "pi*"}, 0, {10.4f, 1.1f}, {10.9f, 1.2f}, kFarkas},
    {"pupils p-p", Kind::straight, {"p l", "p r"}, 0, {64.0f, 3.4f}, {61.7f, 3.6f}, kAnsur},
    {"mouth width ch-ch",
     Kind::straight,
     {"ch l", "ch r"},
     0,
     {54.5f, 3.0f},
     {50.2f, 3.5f},
     kFarkas},
    {"upper lip skin sn-sto",
     Kind::straight,
     {"sn", "sto"},
     0,
     {22.3f, 2.1f},
     {20.1f, 2.0f},
     kFarkas},
    {"upper lip ls-sto", Kind::straight, {"ls", "sto"}, 0, {8.0f, 0}, {8.4f, 0}, kFarkas},
    {"lower lip sto-li", Kind::straight, {"sto", "li"}, 0, {9.3f, 0}, {9.7f, 0}, kFarkas},
    {"chin sto-gn", Kind::straight, {"sto", "gn"}, 0, {50.7f, 4.4f}, {43.4f, 3.1f}, kFarkas},
    {"ear length sa-sba", Kind::straight, {"sa*", "sba*"}, 0, {62.4f, 0}, {58.5f, 0}, kFarkas},
    {"ear breadth pra-pa", Kind::straight, {"pra*", "pa*"}, 0, {35.4f, 0}, {33.5f, 0}, kFarkas},
    {"head height v-t", Kind::axial, {"v", "t*"}, 1, {131.1f, 6.2f}, {126.5f, 6.5f}, kAnsur},
    {"vertex to hair line v-tr", Kind::axial, {"v", "tr"}, 1, {}, {}, kNone},
    {"face depth prn-t", Kind::axial, {"prn", "t*"}, 2, {}, {}, kNone},
    {"eye behind brow sci-p", Kind::axial, {"sci*", "p*"}, 2, {}, {}, kNone},
    {"cheek ch-t", Kind::tangential, {"ch*", "t*"}, 0, {}, {}, kNone},
    {"bitragion-chin arc t-gn-t",
     Kind::tangential,
     {"t l", "gn", "t r"},
     0,
     {331.7f, 14.0f},
     {311.0f, 14.2f},
     kAnsur},
    {"head circumference",
     Kind::tangential,
     {"g", "eu l", "op", "eu r", "g"},
     0,
     {574.0f, 16.0f},
     {561.0f, 19.0f},
     kAnsur},
    {"ear axis sba-sa", Kind::inclination, {"sba*", "sa*"}, 0, {}, {}, kNone},
    {"nose bridge prn-n", Kind::inclination, {"prn", "n"}, 0, {}, {}, kNone},
    {"upper lip ls-sn", Kind::inclination, {"ls", "sn"}, 0, {}, {}, kNone},
    {"lower face gn-sn", Kind::inclination, {"gn", "sn"}, 0, {}, {}, kNone},
    {"nasolabial c'-sn-ls", Kind::angle, {"c'", "sn", "ls"}, 0, {100.0f, 0}, {104.0f, 0}, kFarkas},
    {"nasofrontal g-n-prn", Kind::angle, {"g", "n", "prn"}, 0, {130.0f, 0}, {134.0f, 0}, kFarkas},
    {"nose tip n-prn-sn", Kind::angle, {"n", "prn", "sn"}, 0, {}, {}, kNone},
    {"mentolabial li-sl-pg", Kind::angle, {"li", "sl", "pg"}, 0, {}, {}, kNone},
    {"chin sl-pg-gn", Kind::angle, {"sl", "pg", "gn"}, 0, {}, {}, kNone}};

// The entry's landmarks with * read as one side; empty when the head lacks one.
std::vector<Vec3> places(const MeasuredHead& head, const Entry& entry, const char* side) {
  std::vector<Vec3> out;
  for (const char* landmark : entry.landmarks) {
    if (landmark == nullptr) break;
    std::string name = landmark;
    if (name.back() == '*') name.replace(name.size() - 1, 1, std::string(" ") + side);
    const auto found = head.landmarks.find(name);
    if (found == head.landmarks.end()) return {};
    out.push_back(found->second.place_m);
  }
  return out;
}

float value_of(const MeasuredHead& head, const SkinTape& tape, const Entry& entry,
               const std::vector<Vec3>& p) {
  constexpr float kMillimetres = 1000.0f;
  switch (entry.kind) {
    case Kind::straight:
      return kMillimetres * glm::length(p[1] - p[0]);
    case Kind::axial:
      return kMillimetres *
             std::abs((head.in_frankfurt(p[1]) - head.in_frankfurt(p[0]))[entry.axis]);
    case Kind::tangential: {
      float sum = 0;
      for (std::size_t i = 1; i < p.size(); ++i)
        sum += tape.distance_m(tape.nearest_vertex(p[i - 1]), tape.nearest_vertex(p[i]));
      return kMillimetres * sum;
    }
    case Kind::inclination:
      return inclination_degrees(head.in_frankfurt(p[0]), head.in_frankfurt(p[1]));
    case Kind::angle:
      return angle_degrees(p[0], p[1], p[2]);
  }
  return 0;
}

}  // namespace

const char* name_of(Kind kind) {
  constexpr const char* kNames[] = {"straight", "axial", "tangential", "inclination", "angle"};
  return kNames[static_cast<std::size_t>(kind)];
}

float inclination_degrees(Vec3 from, Vec3 to) {
  return kDegrees * std::atan2(to.z - from.z, to.y - from.y);
}

float angle_degrees(Vec3 a, Vec3 vertex, Vec3 b) {
  const float cosine = glm::dot(glm::normalize(a - vertex), glm::normalize(b - vertex));
  return kDegrees * std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

std::vector<Measurement> measure(const MeasuredHead& head) {
  const SkinTape tape(head.position_m, head.triangles);
  std::vector<Measurement> out;
  for (const Entry& entry : kEntries) {
    const bool both =
        std::any_of(std::begin(entry.landmarks), std::end(entry.landmarks),
                    [](const char* n) { return n && n[std::string_view(n).size() - 1] == '*'; });
    const std::vector<Vec3> left = places(head, entry, "l"), right = places(head, entry, "r");
    if (left.empty() || right.empty()) continue;
    Measurement m{entry.name, entry.kind, value_of(head, tape, entry, left), {}, {}, entry.source};
    if (both) m.value = 0.5f * (m.value + value_of(head, tape, entry, right));
    if (!std::isfinite(m.value)) continue;  // No way along the skin.
    if (entry.men.mean != 0) m.men = entry.men;
    if (entry.women.mean != 0) m.women = entry.women;
    out.push_back(std::move(m));
  }
  return out;
}

namespace {

std::string norm_text(const std::optional<Norm>& norm) {
  char text[32] = "";
  if (norm && norm->deviation > 0)
    std::snprintf(text, sizeof text, "%.1f +- %.1f", double(norm->mean), double(norm->deviation));
  else if (norm)
    std::snprintf(text, sizeof text, "%.1f", double(norm->mean));
  return text;
}

nlohmann::json norm_json(const std::optional<Norm>& norm) {
  if (!norm) return nullptr;
  nlohmann::json out{{"mean", norm->mean}};
  if (norm->deviation > 0) out["deviation"] = norm->deviation;
  return out;
}

}  // namespace

std::string as_table(std::span<const Measurement> measurements) {
  std::string out =
      "anthropometry (mm, degrees)     kind           value   men             women\n";
  for (const Measurement& m : measurements) {
    char line[160];
    std::snprintf(line, sizeof line, "  %-29s %-11s %8.1f   %-15s %s", m.name.c_str(),
                  name_of(m.kind), double(m.value), norm_text(m.men).c_str(),
                  norm_text(m.women).c_str());
    out += line;
    out.erase(out.find_last_not_of(' ') + 1);
    out += "\n";
  }
  return out;
}

std::string as_json(const MeasuredHead& head, std::span<const Measurement> measurements) {
  nlohmann::json out;
  for (const auto& [name, landmark] : head.landmarks)
    out["landmarks"][name] = {{"m", {landmark.place_m.x, landmark.place_m.y, landmark.place_m.z}},
                              {"source", landmark.source}};
  out["to_frankfurt_degrees"] = kDegrees * head.to_frankfurt_rad;
  for (const Measurement& m : measurements) {
    nlohmann::json entry{
        {"name", m.name},
        {"kind", name_of(m.kind)},
        {"value", m.value},
        {"unit", m.kind == Kind::inclination || m.kind == Kind::angle ? "degrees" : "mm"},
        {"men", norm_json(m.men)},
        {"women", norm_json(m.women)}};
    if (*m.source != '\0') entry["norm_source"] = m.source;
    out["measurements"].push_back(std::move(entry));
  }
  return out.dump(2) + "\n";
}

}  // namespace caryatid::bake::anthropometry
