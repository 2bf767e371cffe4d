#include "core/face/fap_table.h"

#include <cassert>
#include <cstring>

namespace caryatid::face {
namespace {

using enum FapUnit;
constexpr FapDirection kNone = FapDirection::none, kUp = FapDirection::up,
                       kDown = FapDirection::down, kLeft = FapDirection::left,
                       kRight = FapDirection::right, kForward = FapDirection::forward,
                       kGrowing = FapDirection::growing, kConcave = FapDirection::concave_upward;

// name, unit, bidirectional, positive direction, group, feature point, quantiser, intra and inter
// range, partner. FAP 15: MW (annex C, Xface, Greta; one tool says MNS). FAP 18: up (annex C,
// Xface, Greta; the Candide model goes down). FAP 47: annex C has +-300 where the codec has +-1080.
// clang-format off
constexpr FapInfo kFaps[kFapCount + 1] = {
    {"", none, false, kNone, 0, {}, 1, 0, 0, 0},
    {"viseme", none, false, kNone, 1, {}, 1, 0, 0, 0},
    {"expression", none, false, kNone, 1, {}, 1, 0, 0, 0},
    {"open_jaw", mns, false, kDown, 2, {2, 1}, 4, 1080, 360, 0},
    {"lower_t_midlip", mns, true, kDown, 2, {2, 2}, 2, 600, 180, 0},
    {"raise_b_midlip", mns, true, kUp, 2, {2, 3}, 2, 1860, 600, 0},
    {"stretch_l_cornerlip", mw, true, kLeft, 2, {2, 4}, 2, 600, 180, 7},
    {"stretch_r_cornerlip", mw, true, kRight, 2, {2, 5}, 2, 600, 180, 6},
    {"lower_t_lip_lm", mns, true, kDown, 2, {2, 6}, 2, 600, 180, 9},
    {"lower_t_lip_rm", mns, true, kDown, 2, {2, 7}, 2, 600, 180, 8},
    {"raise_b_lip_lm", mns, true, kUp, 2, {2, 8}, 2, 1860, 600, 11},
    {"raise_b_lip_rm", mns, true, kUp, 2, {2, 9}, 2, 1860, 600, 10},
    {"raise_l_cornerlip", mns, true, kUp, 2, {2, 4}, 2, 600, 180, 13},
    {"raise_r_cornerlip", mns, true, kUp, 2, {2, 5}, 2, 600, 180, 12},
    {"thrust_jaw", mns, false, kForward, 2, {2, 1}, 1, 600, 180, 0},
    {"shift_jaw", mw, true, kRight, 2, {2, 1}, 1, 1080, 360, 0},
    {"push_b_lip", mns, true, kForward, 2, {2, 3}, 1, 1080, 360, 0},
    {"push_t_lip", mns, true, kForward, 2, {2, 2}, 1, 1080, 360, 0},
    {"depress_chin", mns, true, kUp, 2, {2, 10}, 1, 420, 180, 0},
    {"close_t_l_eyelid", irisd, true, kDown, 3, {3, 1}, 1, 1080, 600, 20},
    {"close_t_r_eyelid", irisd, true, kDown, 3, {3, 2}, 1, 1080, 600, 19},
    {"close_b_l_eyelid", irisd, true, kUp, 3, {3, 3}, 1, 600, 240, 22},
    {"close_b_r_eyelid", irisd, true, kUp, 3, {3, 4}, 1, 600, 240, 21},
    {"yaw_l_eyeball", au, true, kLeft, 3, {3, 5}, 128, 1200, 420, 24},
    {"yaw_r_eyeball", au, true, kLeft, 3, {3, 6}, 128, 1200, 420, 23},
    {"pitch_l_eyeball", au, true, kDown, 3, {3, 5}, 128, 900, 300, 26},
    {"pitch_r_eyeball", au, true, kDown, 3, {3, 6}, 128, 900, 300, 25},
    {"thrust_l_eyeball", es, true, kForward, 3, {3, 5}, 1, 600, 180, 28},
    {"thrust_r_eyeball", es, true, kForward, 3, {3, 6}, 1, 600, 180, 27},
    {"dilate_l_pupil", irisd, true, kGrowing, 3, {3, 5}, 1, 420, 120, 30},
    {"dilate_r_pupil", irisd, true, kGrowing, 3, {3, 6}, 1, 420, 120, 29},
    {"raise_l_i_eyebrow", ens, true, kUp, 4, {4, 1}, 2, 900, 360, 32},
    {"raise_r_i_eyebrow", ens, true, kUp, 4, {4, 2}, 2, 900, 360, 31},
    {"raise_l_m_eyebrow", ens, true, kUp, 4, {4, 3}, 2, 900, 360, 34},
    {"raise_r_m_eyebrow", ens, true, kUp, 4, {4, 4}, 2, 900, 360, 33},
    {"raise_l_o_eyebrow", ens, true, kUp, 4, {4, 5}, 2, 900, 360, 36},
    {"raise_r_o_eyebrow", ens, true, kUp, 4, {4, 6}, 2, 900, 360, 35},
    {"squeeze_l_eyebrow", es, true, kRight, 4, {4, 1}, 1, 900, 300, 38},
    {"squeeze_r_eyebrow", es, true, kLeft, 4, {4, 2}, 1, 900, 300, 37},
    {"puff_l_cheek", es, true, kLeft, 5, {5, 1}, 2, 900, 300, 40},
    {"puff_r_cheek", es, true, kRight, 5, {5, 2}, 2, 900, 300, 39},
    {"lift_l_cheek", ens, false, kUp, 5, {5, 3}, 2, 600, 180, 42},
    {"lift_r_cheek", ens, false, kUp, 5, {5, 4}, 2, 600, 180, 41},
    {"shift_tongue_tip", mw, true, kRight, 6, {6, 1}, 1, 1080, 420, 0},
    {"raise_tongue_tip", mns, true, kUp, 6, {6, 1}, 1, 1080, 420, 0},
    {"thrust_tongue_tip", mw, true, kForward, 6, {6, 1}, 1, 1080, 420, 0},
    {"raise_tongue", mns, true, kUp, 6, {6, 2}, 1, 1080, 420, 0},
    {"tongue_roll", au, false, kConcave, 6, {6, 3}, 512, 1080, 420, 0},
    {"head_pitch", au, true, kDown, 7, {7, 1}, 170, 1860, 600, 0},
    {"head_yaw", au, true, kLeft, 7, {7, 1}, 170, 1860, 600, 0},
    {"head_roll", au, true, kRight, 7, {7, 1}, 170, 1860, 600, 0},
    {"lower_t_midlip_o", mns, true, kDown, 8, {8, 1}, 2, 600, 180, 0},
    {"raise_b_midlip_o", mns, true, kUp, 8, {8, 2}, 2, 1860, 600, 0},
    {"stretch_l_cornerlip_o", mw, true, kLeft, 8, {8, 3}, 2, 600, 180, 54},
    {"stretch_r_cornerlip_o", mw, true, kRight, 8, {8, 4}, 2, 600, 180, 53},
    {"lower_t_lip_lm_o", mns, true, kDown, 8, {8, 5}, 2, 600, 180, 56},
    {"lower_t_lip_rm_o", mns, true, kDown, 8, {8, 6}, 2, 600, 180, 55},
    {"raise_b_lip_lm_o", mns, true, kUp, 8, {8, 7}, 2, 1860, 600, 58},
    {"raise_b_lip_rm_o", mns, true, kUp, 8, {8, 8}, 2, 1860, 600, 57},
    {"raise_l_cornerlip_o", mns, true, kUp, 8, {8, 3}, 2, 600, 180, 60},
    {"raise_r_cornerlip_o", mns, true, kUp, 8, {8, 4}, 2, 600, 180, 59},
    {"stretch_l_nose", ens, true, kLeft, 9, {9, 1}, 1, 540, 120, 62},
    {"stretch_r_nose", ens, true, kRight, 9, {9, 2}, 1, 540, 120, 61},
    {"raise_nose", ens, true, kUp, 9, {9, 3}, 1, 680, 180, 0},
    {"bend_nose", ens, true, kRight, 9, {9, 3}, 1, 900, 180, 0},
    {"raise_l_ear", ens, true, kUp, 10, {10, 1}, 1, 900, 240, 66},
    {"raise_r_ear", ens, true, kUp, 10, {10, 2}, 1, 900, 240, 65},
    {"pull_l_ear", ens, true, kLeft, 10, {10, 3}, 1, 900, 300, 68},
    {"pull_r_ear", ens, true, kRight, 10, {10, 4}, 1, 900, 300, 67},
};
// clang-format on

constexpr FapGroup kGroups[kFapGroupCount + 1] = {{0, 0},   {1, 2},   {3, 18},  {19, 30},
                                                  {31, 38}, {39, 42}, {43, 47}, {48, 50},
                                                  {51, 60}, {61, 64}, {65, 68}};

}  // namespace

const FapInfo& fap_info(int fap) {
  assert(fap >= 1 && fap <= kFapCount);
  return kFaps[fap];
}

FapGroup fap_group(int group) {
  assert(group >= 1 && group <= kFapGroupCount);
  return kGroups[group];
}

int find_fap(const char* name) {
  for (int fap = 1; fap <= kFapCount; ++fap)
    if (std::strcmp(kFaps[fap].name, name) == 0) return fap;
  return 0;
}

Vec3 direction_vector(FapDirection direction) {
  switch (direction) {
    case FapDirection::up:
      return {0, 1, 0};
    case FapDirection::down:
      return {0, -1, 0};
    case FapDirection::left:
      return {1, 0, 0};
    case FapDirection::right:
      return {-1, 0, 0};
    case FapDirection::forward:
      return {0, 0, 1};
    case FapDirection::none:
    case FapDirection::growing:
    case FapDirection::concave_upward:
      break;
  }
  return {0, 0, 0};
}

}  // namespace caryatid::face
