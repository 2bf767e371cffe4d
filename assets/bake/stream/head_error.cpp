#include "assets/bake/stream/head_error.h"

#include <algorithm>
#include <stdexcept>

#include "assets/bake/files/files.h"
#include "core/face/fap_fill.h"
#include "core/face/mixer.h"

namespace caryatid::bake {
namespace {

constexpr int kFirstFaceGroup = 2, kLastFaceGroup = 11;
constexpr float kMillimetres = 1000.0f;

}  // namespace

HeadMeter::HeadMeter(const std::string& pack_path) {
  const std::string text = read_file(pack_path);
  const auto file = std::as_bytes(std::span(text));
  const auto refuse = [&pack_path](const char* what) {
    throw std::runtime_error(pack_path + ": " + what + "; bake it again");
  };
  const Result<pack::PackHeader> header = pack::read_header(file);
  if (!header.ok()) refuse("not a pack, or of another version");
  image_.resize(header.value.image_bytes / sizeof(Vec4) + 1);
  loader_ = std::make_unique<pack::Loader>();
  if (!loader_->begin(header.value, std::as_writable_bytes(std::span(image_))).ok() ||
      !loader_->feed(file.subspan(sizeof(pack::PackHeader))).ok() || !loader_->end().ok())
    refuse("the pack is damaged");
  memory_.resize(agent::Person::arena_bytes(loader_->view()));
  Arena arena(memory_);
  person_ = std::make_unique<agent::Person>();
  if (!person_->start(loader_->view(), arena).ok()) refuse("its meshes are damaged");
}

std::vector<Vec3> HeadMeter::points_of(const face::FapFrame& frame) {
  face::FapFrame filled = frame;
  face::fill_from_partners(&filled, person_->fit());
  face::MixJob mix;
  mix.stream = &filled;
  mix.limits = &person_->limits();
  person_->show(mix.run(), body::BapFrame{}, Affine{}, 0.0f);
  std::vector<Vec3> points;
  for (const pack::FeaturePoint& p : loader_->view().feature_points)
    if (p.group >= kFirstFaceGroup && p.group <= kLastFaceGroup)
      points.push_back(person_->feature_point_m(p.group, p.index));
  return points;
}

PointError HeadMeter::measure(const std::vector<face::FapFrame>& original,
                              const std::vector<face::FapFrame>& decoded) {
  std::vector<double> errors_mm;
  for (std::size_t i = 0; i < std::min(original.size(), decoded.size()); ++i) {
    const std::vector<Vec3> want = points_of(original[i]), got = points_of(decoded[i]);
    for (std::size_t p = 0; p < want.size(); ++p)
      errors_mm.push_back(static_cast<double>(glm::length(want[p] - got[p]) * kMillimetres));
  }
  return summary_of(std::move(errors_mm));
}

}  // namespace caryatid::bake
