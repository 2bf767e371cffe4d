#include "assets/bake/face/smooth.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <stdexcept>

namespace caryatid::bake::fat {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplet = Eigen::Triplet<double>;
using Vec3d = glm::dvec3;

// Cotangent Laplacian (positive semidefinite) and lumped areas, in millimetres: metres would leave
// the squared operator badly scaled.
void assemble(const Skin& skin, Sparse& laplacian, std::vector<double>& area) {
  std::vector<Triplet> entries;
  area.assign(skin.size(), 0.0);
  // A sliver's cotangent is unbounded; capping it keeps the system well conditioned.
  constexpr double kLeast = 0.02, kMost = 20.0;
  for (const auto& t : skin.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t at = t[i], a = t[(i + 1) % 3], b = t[(i + 2) % 3];
      const Vec3d u = 1e3 * Vec3d(skin.position_m[a] - skin.position_m[at]);
      const Vec3d v = 1e3 * Vec3d(skin.position_m[b] - skin.position_m[at]);
      const double twice_area = glm::length(glm::cross(u, v));
      const double cotangent = glm::dot(u, v) / std::max(twice_area, 1e-12);
      const double w = 0.5 * std::clamp(cotangent, kLeast, kMost);
      entries.emplace_back(a, a, w);
      entries.emplace_back(b, b, w);
      entries.emplace_back(a, b, -w);
      entries.emplace_back(b, a, -w);
      area[at] += twice_area / 6.0;
    }
  }
  laplacian.resize(skin.size(), skin.size());
  laplacian.setFromTriplets(entries.begin(), entries.end());
}

void check_reach(const Skin& skin, std::span<const std::uint32_t> given) {
  std::vector<bool> seen(skin.size(), false);
  std::vector<std::uint32_t> open(given.begin(), given.end());
  while (!open.empty()) {
    const std::uint32_t v = open.back();
    open.pop_back();
    if (seen[v]) continue;
    seen[v] = true;
    open.insert(open.end(), skin.neighbours[v].begin(), skin.neighbours[v].end());
  }
  if (std::find(seen.begin(), seen.end(), false) != seen.end())
    throw std::runtime_error("smooth field: part of the skin touches no given vertex");
}

}  // namespace

struct SmoothFields::System {
  std::vector<std::uint32_t> given;
  std::vector<int> free_index;  // By vertex; -1 - position in `given` for the given ones.
  Sparse coupling;              // Free rows x given columns.
  Eigen::SimplicialLDLT<Sparse> factor;
  int free_count = 0;

  Eigen::MatrixXd solve(const Eigen::MatrixXd& values) const {
    if (free_count == 0) return Eigen::MatrixXd(0, values.cols());
    return factor.solve(-(coupling * values));
  }
};

SmoothFields::~SmoothFields() = default;

SmoothFields::SmoothFields(const Skin& skin, std::span<const std::uint32_t> given, int stiffness)
    : system_(std::make_unique<System>()) {
  check_reach(skin, given);
  System& s = *system_;
  s.given.assign(given.begin(), given.end());
  s.free_index.assign(skin.size(), 0);
  for (std::size_t i = 0; i < given.size(); ++i) s.free_index[given[i]] = -1 - static_cast<int>(i);
  for (int& index : s.free_index)
    if (index == 0) index = ++s.free_count;  // From 1, so that 0 still meant "unseen".
  Sparse laplacian;
  std::vector<double> area;
  assemble(skin, laplacian, area);
  Sparse energy = laplacian;
  if (stiffness == 2) {
    std::vector<Triplet> inverse;
    for (std::uint32_t v = 0; v < skin.size(); ++v)
      inverse.emplace_back(v, v, 1.0 / std::max(area[v], 1e-3));
    Sparse mass(skin.size(), skin.size());
    mass.setFromTriplets(inverse.begin(), inverse.end());
    energy = laplacian * mass * laplacian;
  }
  std::vector<Triplet> inner, outer;
  for (int column = 0; column < energy.outerSize(); ++column) {
    for (Sparse::InnerIterator it(energy, column); it; ++it) {
      const int row = s.free_index[static_cast<std::size_t>(it.row())];
      const int other = s.free_index[static_cast<std::size_t>(column)];
      if (row < 0) continue;
      if (other > 0) inner.emplace_back(row - 1, other - 1, it.value());
      if (other < 0) outer.emplace_back(row - 1, -1 - other, it.value());
    }
  }
  if (s.free_count == 0) return;
  Sparse matrix(s.free_count, s.free_count);
  matrix.setFromTriplets(inner.begin(), inner.end());
  s.coupling.resize(s.free_count, static_cast<Eigen::Index>(given.size()));
  s.coupling.setFromTriplets(outer.begin(), outer.end());
  s.factor.compute(matrix);
  if (s.factor.info() != Eigen::Success)
    throw std::runtime_error("smooth field: the system cannot be solved");
}

std::vector<Vec3> SmoothFields::solve(std::span<const Vec3> values) const {
  const System& s = *system_;
  Eigen::MatrixXd right(static_cast<Eigen::Index>(values.size()), 3);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c)
      right(static_cast<Eigen::Index>(i), c) = static_cast<double>(values[i][c]);
  const Eigen::MatrixXd solved = s.solve(right);
  std::vector<Vec3> out(s.free_index.size());
  for (std::size_t v = 0; v < out.size(); ++v) {
    const int index = s.free_index[v];
    for (int c = 0; c < 3; ++c)
      out[v][c] = index < 0 ? values[static_cast<std::size_t>(-1 - index)][c]
                            : static_cast<float>(solved(index - 1, c));
  }
  return out;
}

std::vector<float> SmoothFields::solve(std::span<const float> values) const {
  std::vector<Vec3> triple(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) triple[i] = Vec3(values[i], 0, 0);
  std::vector<float> out;
  for (const Vec3& v : solve(triple)) out.push_back(v.x);
  return out;
}

}  // namespace caryatid::bake::fat
