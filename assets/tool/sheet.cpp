// caryatid-tool sheet: contact sheets with captions.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>
#include <stdexcept>

#include "assets/bake/mesh_io/mesh_io.h"
#include "assets/bake/mesh_io/repair.h"
#include "assets/bake/simplify/history.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/gait_sheet.h"
#include "assets/tool/gait_style_named.h"
#include "assets/tool/gesture_sheet.h"
#include "assets/tool/numbers.h"
#include "assets/tool/progress.h"
#include "assets/tool/raster.h"
#include "assets/tool/speech_sheet.h"
#include "assets/tool/studio.h"
#include "core/emotion/emotion.h"
#include "core/face/fap_fill.h"
#include "core/face/fap_table.h"
#include "core/face/visemes.h"

namespace caryatid::tool {
namespace {

struct SheetArgs {
  std::string pack, mesh, what, out, lod;
  std::vector<std::string> moods;
  VoiceJob voice;
  std::uint32_t cell = 400;
  long shuffle = -1;
};

struct Cells {
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
};

// Portraits of the face from brow to chin, or of the mouth with nose and chin.
enum class Portrait { face, mouth };

scene::Framing portrait(const Studio& studio, Portrait which) {
  const scene::Subject subject = scene::subject_of(studio.person().view());
  scene::Framing f = scene::framing(scene::View::head, subject);
  const bool mouth = which == Portrait::mouth;
  f.target_m = subject.eyes_m - Vec3{0, mouth ? 0.075f : 0.038f, 0};
  f.visible_height_m = f.visible_width_m = mouth ? 0.13f : 0.225f;
  return f;
}

Cells emotions(Studio* studio, const std::string& lod) {
  Cells cells;
  for (const std::string_view name : emotion::kEmotionNames) {
    Pose pose;
    pose.faps = emotion_named(std::string(name));
    if (!lod.empty()) set_lod(lod, &pose);
    cells.pictures.push_back(studio->picture(pose));
    cells.captions.emplace_back(name);
  }
  return cells;
}

Cells visemes(Studio* studio) {
  constexpr const char* kPhonemes[face::kVisemeCount] = {"none", "p b m",   "f v", "th",  "t d",
                                                         "k g",  "ch j sh", "s z", "n l", "r",
                                                         "a:",   "e",       "i",   "o",   "u"};
  Cells cells;
  for (int v = 0; v < face::kVisemeCount; ++v) {
    Pose pose;
    pose.faps = face::viseme_frame(v);
    pose.framing = portrait(*studio, Portrait::mouth);
    cells.pictures.push_back(studio->picture(pose));
    cells.captions.push_back(std::to_string(v) + "  " + kPhonemes[v]);
  }
  return cells;
}

// Five sounds that a lip-reader tells apart, each from the middle of a spoken word.
Cells lips(Studio* studio) {
  struct Example {
    const char *sound, *word, *ipa;
  };
  constexpr Example kExamples[] = {{"p", "apart", "p"},
                                   {"f", "afar", "f"},
                                   {"th", "Athena", "θ"},
                                   {"o", "awful", "ɔː"},
                                   {"ee", "agreed", "iː"}};
  Cells cells;
  for (const Example& e : kExamples) {
    const Spoken spoken = speak({.text = e.word});
    for (std::size_t i = 0; i + 1 < spoken.events.size(); ++i) {
      const SpokenEvent& event = spoken.events[i];
      if (event.kind != SpokenEvent::Kind::phone || !event.text.ends_with(e.ipa)) continue;
      const std::int32_t middle_ms = (event.time_ms + spoken.events[i + 1].time_ms) / 2;
      cells.pictures.push_back(
          speech_picture(spoken, {.time_ms = middle_ms - 20, .mouth_only = true}, studio));
      cells.captions.emplace_back(e.sound);
      break;
    }
  }
  return cells;
}

// One FAP at some value. The tongue shows in an open mouth only; heads that turn need their room.
Pose pose_of(const Studio& studio, int fap, float value) {
  Pose pose;
  const bool tongue = fap >= 43 && fap <= 47, turns = fap >= 48 && fap <= 50;
  if (tongue)
    for (const auto& [open, by] : {std::pair{3, 520.0f}, {4, -120.0f}, {5, -560.0f}})
      pose.faps.set(open, by);
  face::fill_from_partners(&pose.faps);
  if (fap == 43 || fap == 47) pose.faps.set(45, 240.0f);  // What goes sideways or rolls comes out.
  pose.faps.set(fap, value);
  if (!turns) pose.framing = portrait(studio, tongue ? Portrait::mouth : Portrait::face);
  return pose;
}

Cells faps(Studio* studio) {
  Cells cells;
  Progress progress;
  const face::FapLimits& limits = studio->person().limits();
  for (int fap = 3; fap <= face::kFapCount; ++fap) {
    const auto n = static_cast<std::size_t>(fap);
    progress.step("FAP", n, face::kFapCount);
    for (const float end : {limits.low[n], limits.high[n]}) {
      if (end == 0.0f) continue;
      // The ends of the working range: the table reaches a little further.
      const float value = end / face::kReach;
      cells.pictures.push_back(studio->picture(pose_of(*studio, fap, value)));
      char text[96];
      std::snprintf(text, sizeof text, "%d %s %.0f", fap,
                    std::string(face::fap_info(fap).name).c_str(), static_cast<double>(value));
      cells.captions.emplace_back(text);
    }
  }
  return cells;
}

bake::Surface head_surface(const agent::Person& person) {
  bake::Surface out;
  for (std::size_t o = 0; o < person.object_count(); ++o) {
    if (person.view().objects[o].role != pack::ObjectRole::head) continue;
    const scene::MeshView& mesh = person.meshes()[o];
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v)
      out.position.emplace_back(mesh.dynamic[v].position_m);
    for (std::size_t i = 0; i < 3 * std::size_t{mesh.triangle_count}; i += 3)
      out.triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  return out;
}

void add_wireframes(const std::vector<Picture>& wireframes, Cells* cells) {
  cells->pictures.insert(cells->pictures.end(), wireframes.begin(), wireframes.end());
  cells->captions.resize(cells->pictures.size());
}

// The levels of the head in thesis figure 3-6, shaded and as wireframe.
Cells lods(Studio* studio, std::uint32_t side) {
  Cells cells;
  std::vector<Picture> wireframes;
  for (const std::uint32_t faces : {2141u, 1929u, 1307u, 680u}) {
    Pose pose;
    pose.head_lod = faces;
    cells.pictures.push_back(studio->picture(pose));
    const bake::Surface head = head_surface(studio->person());
    std::string caption = std::to_string(head.triangles.size()) + " faces of the head";
    // A collapse takes two faces, and one alone only at a border: every second number is passed by.
    if (head.triangles.size() + 1 == faces) caption += " (of " + std::to_string(faces) + ", odd)";
    cells.captions.push_back(std::move(caption));
    wireframes.push_back(draw_surface(head, whole_of(head, 0, 0), true, side));
  }
  add_wireframes(wireframes, &cells);
  return cells;
}

// Any mesh at full, half, a quarter and a tenth, as thesis figures 3-4 and 3-5.
Cells mesh_lods(const std::string& path, std::uint32_t side) {
  bake::RepairReport repairs;
  const bake::Surface original = bake::repair_surface(bake::read_mesh(path), &repairs);
  if (original.triangles.empty()) throw bake::MeshError(path + ": no face is left after repair");
  const RasterView view = whole_of(original, 0.5, 0.5);
  bake::CollapseOptions options;
  options.target_triangles = 0;
  Progress progress;
  progress.step("simplifying");
  const bake::History history = bake::record_history(original, options);
  bake::HistoryCursor cursor(history);
  Cells cells;
  std::vector<Picture> wireframes;
  for (const double share : {1.0, 0.5, 0.25, 0.1}) {
    cursor.go_to(static_cast<std::uint32_t>(share * history.max_triangles()));
    const bake::Surface level = cursor.surface();
    cells.pictures.push_back(draw_surface(level, view, false, side));
    cells.captions.push_back(std::to_string(level.triangles.size()) + " faces");
    wireframes.push_back(draw_surface(level, view, true, side));
  }
  add_wireframes(wireframes, &cells);
  return cells;
}

// For blind judgement: another order, no captions; the order goes to stdout.
void shuffle(unsigned seed, Cells* cells) {
  std::vector<std::size_t> order(cells->pictures.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937 random(seed);
  std::shuffle(order.begin(), order.end(), random);
  Cells out;
  for (std::size_t i = 0; i < order.size(); ++i) {
    out.pictures.push_back(cells->pictures[order[i]]);
    std::printf("%zu %s\n", i + 1, cells->captions[order[i]].c_str());
    out.captions.push_back(std::to_string(i + 1));
  }
  *cells = out;
}

void sheet(const SheetArgs& a) {
  if (!a.mesh.empty()) {
    const Cells levels = mesh_lods(a.mesh, a.cell);
    write_png(grid(levels.pictures, levels.captions, 4), a.out);
    return;
  }
  if (a.what == "speech") check_text("--text", a.voice.text);
  Studio studio(a.pack, a.cell, a.cell);
  if (a.what == "speech") {
    write_png(speech_strip(speak(a.voice), a.voice.text, a.cell, &studio), a.out);
    return;
  }
  Cells cells;
  std::uint32_t columns = 4;
  if (a.what == "emotions") cells = emotions(&studio, a.lod);
  if (a.what == "visemes") cells = visemes(&studio), columns = 5;
  if (a.what == "faps") cells = faps(&studio), columns = 10;
  if (a.what == "gait") {
    // Named moods give the strips of their cycles; none, the key poses of all.
    Progress progress;
    for (const std::string& mood : a.moods) {
      progress.step("walk " + mood);
      cells.pictures.push_back(gait_strip(&studio, style_named(mood)));
      cells.captions.push_back(mood);
      columns = 1;
    }
    if (a.moods.empty()) {
      GaitCells gait = gait_poses(&studio);
      cells = {std::move(gait.pictures), std::move(gait.captions)};
    }
  }
  if (a.what == "gestures") {
    GaitCells gestures = gesture_poses(&studio);
    cells = {std::move(gestures.pictures), std::move(gestures.captions)};
  }
  if (a.what == "lips") cells = lips(&studio), columns = 5;
  if (a.what == "lods") cells = lods(&studio, a.cell);
  if (a.shuffle >= 0) shuffle(static_cast<unsigned>(a.shuffle), &cells);
  write_png(grid(cells.pictures, cells.captions, columns), a.out);
}

}  // namespace

void add_sheet(CLI::App& app) {
  auto a = std::make_shared<SheetArgs>();
  CLI::App* cmd = app.add_subcommand("sheet", "A contact sheet with captions");
  cmd->add_option("what", a->what, "emotions visemes faps lods gait gestures speech lips")
      ->required()
      ->check(CLI::IsMember(
          {"emotions", "visemes", "faps", "lods", "gait", "gestures", "speech", "lips"}));
  CLI::Option* pack = reads(cmd->add_option("--pack", a->pack, "The character"));
  CLI::Option* mesh =
      reads(cmd->add_option("--mesh", a->mesh, "lods: any .obj, .off or .ply instead"));
  mesh->excludes(pack);
  cmd->add_option("--lod", a->lod, "emotions: triangles, N or head=N (default all)");
  cmd->add_option("--cell", a->cell, "Pixels of a picture (default 400)")
      ->check(number_from(64, 1024));
  cmd->add_option("--mood", a->moods,
                  "gait: strips of these moods (or run), by commas, in place of all key poses")
      ->delimiter(',')
      ->check(CLI::IsMember(
          {"normal", "bored", "happy", "sad", "angry", "hurried", "tired", "proud", "run"}));
  cmd->add_option("--text", a->voice.text, "speech: what is said");
  cmd->add_option("--language", a->voice.language, "speech: its language (default en)");
  cmd->add_option("--shuffle", a->shuffle,
                  "Seed: numbers in place of captions, in random order; the key goes to stdout");
  writes(cmd->add_option("-o,--out", a->out, "OUT.png or OUT.jpg")->required(), {".png", ".jpg"});
  cmd->footer("example: caryatid-tool sheet emotions --pack woman.pack -o emotions.png");
  on_run(cmd, [a] {
    if (a->pack.empty() && (a->mesh.empty() || a->what != "lods"))
      throw UsageError("give --pack PACK, or for lods --mesh FILE");
    sheet(*a);
  });
}

}  // namespace caryatid::tool
