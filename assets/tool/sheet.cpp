// caryatid-tool sheet: contact sheets with captions.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>
#include <stdexcept>

#include "assets/tool/commands.h"
#include "assets/tool/gait_sheet.h"
#include "assets/tool/studio.h"
#include "core/emotion/emotion.h"
#include "core/face/fap_table.h"
#include "core/face/visemes.h"

namespace caryatid::tool {
namespace {

struct SheetArgs {
  std::string pack, what, out, mood;
  std::uint32_t cell = 400;
  long shuffle = -1;
};

struct Cells {
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
};

Cells emotions(Studio* studio) {
  Cells cells;
  for (const std::string_view name : emotion::kEmotionNames) {
    Pose pose;
    pose.faps = emotion_named(std::string(name));
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
    cells.pictures.push_back(studio->picture(pose));
    cells.captions.push_back(std::to_string(v) + "  " + kPhonemes[v]);
  }
  return cells;
}

Cells faps(Studio* studio) {
  Cells cells;
  const face::FapLimits& limits = studio->person().limits();
  for (int fap = 3; fap <= face::kFapCount; ++fap) {
    const auto n = static_cast<std::size_t>(fap);
    for (const float end : {limits.low[n], limits.high[n]}) {
      if (end == 0.0f) continue;
      Pose pose;
      // The ends of the working range: the table reaches a little further.
      pose.faps.set(fap, end / face::kReach);
      cells.pictures.push_back(studio->picture(pose));
      char text[96];
      std::snprintf(text, sizeof text, "%d %s %.0f", fap,
                    std::string(face::fap_info(fap).name).c_str(),
                    static_cast<double>(end / face::kReach));
      cells.captions.emplace_back(text);
    }
  }
  return cells;
}

Cells lods(Studio* studio) {
  Cells cells;
  std::uint32_t all = studio->person().view().character->total_triangles;
  for (const double share : {1.0, 0.5, 0.25, 0.12, 0.06, 0.03}) {
    Pose pose;
    pose.lod = static_cast<std::uint32_t>(share * all);
    cells.pictures.push_back(studio->picture(pose));
    cells.captions.push_back(std::to_string(studio->person().triangle_count()) + " triangles");
  }
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
  Studio studio(a.pack, a.cell, a.cell);
  Cells cells;
  std::uint32_t columns = 4;
  if (a.what == "emotions") cells = emotions(&studio);
  if (a.what == "visemes") cells = visemes(&studio), columns = 5;
  if (a.what == "faps") cells = faps(&studio), columns = 10;
  if (a.what == "gait") {
    // A named mood gives the strip of its cycle; none, the key poses of all.
    GaitCells gait;
    for (int m = 0; m < body::kGaitMoodCount; ++m)
      if (a.mood == body::gait_mood_name(body::GaitMood(m)))
        gait = gait_strip(&studio, body::gait_style(body::GaitMood(m)));
    if (a.mood == "run") gait = gait_strip(&studio, body::running_style());
    if (a.mood.empty()) gait = gait_poses(&studio);
    cells = {gait.pictures, gait.captions};
    columns = a.mood.empty() ? 4 : 8;
  }
  if (a.what == "lods") cells = lods(&studio), columns = 3;
  if (a.shuffle >= 0) shuffle(static_cast<unsigned>(a.shuffle), &cells);
  write_png(grid(cells.pictures, cells.captions, columns), a.out);
}

}  // namespace

void add_sheet(CLI::App& app) {
  auto a = std::make_shared<SheetArgs>();
  CLI::App* cmd = app.add_subcommand("sheet", "A contact sheet with captions");
  cmd->add_option("what", a->what, "emotions visemes faps lods gait")
      ->required()
      ->check(CLI::IsMember({"emotions", "visemes", "faps", "lods", "gait"}));
  cmd->add_option("--pack", a->pack, "The character")->required();
  cmd->add_option("--cell", a->cell, "Pixels of a picture (default 400)")
      ->check(CLI::Range(64, 1024));
  cmd->add_option("--mood", a->mood,
                  "gait: the strip of this mood (or run) in place of the key poses of all")
      ->check(CLI::IsMember(
          {"normal", "bored", "happy", "sad", "angry", "hurried", "tired", "proud", "run"}));
  cmd->add_option("--shuffle", a->shuffle,
                  "Seed: numbers in place of captions, in random order; the key goes to stdout");
  cmd->add_option("-o,--out", a->out, "OUT.png")->required();
  cmd->footer("example: caryatid-tool sheet emotions --pack woman.pack -o emotions.png");
  cmd->callback([a] { sheet(*a); });
}

}  // namespace caryatid::tool
