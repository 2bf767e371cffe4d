#include "tests/bench/simplify_peers.h"

// The peers run as released: without their assertions.
#define NDEBUG
#define CGAL_NDEBUG
#include <ctime>

#include "tests/bench/heap.h"

// Optimised, the templates of others warn from within ours.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#if __has_include(<CGAL/Surface_mesh.h>)
#define CARYATID_HAS_CGAL 1
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#else
#define CARYATID_HAS_CGAL 0
#endif
#if __has_include(<meshoptimizer.h>)
#define CARYATID_HAS_MESHOPTIMIZER 1
#include <meshoptimizer.h>
#else
#define CARYATID_HAS_MESHOPTIMIZER 0
#endif

namespace caryatid::bench {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

namespace {

PeerRun run_ours(const bake::Surface& s, std::uint32_t faces) {
  PeerRun out;
  const std::size_t before = heap_bytes();
  bake::Surface copy = s;
  reset_heap_peak();
  bake::CollapseOptions options;
  options.target_triangles = faces;
  const double began = cpu_seconds();
  out.result = bake::collapse_edges(std::move(copy), options);
  out.seconds = cpu_seconds() - began;
  out.peak_bytes = static_cast<double>(heap_peak_bytes() - before);
  return out;
}

#if CARYATID_HAS_CGAL
namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct StopAt {
  std::size_t faces;
  const CgalMesh* mesh;
  template <class F, class Profile>
  bool operator()(const F&, const Profile&, std::size_t, std::size_t) const {
    return mesh->number_of_faces() <= faces;
  }
};

template <class Simplify>
PeerRun run_cgal(const bake::Surface& s, Simplify&& simplify) {
  PeerRun out;
  const std::size_t before = heap_bytes();
  CgalMesh mesh;
  for (const auto& p : s.position) mesh.add_vertex({p.x, p.y, p.z});
  for (const bake::Triangle& t : s.triangles)
    mesh.add_face(CgalMesh::Vertex_index(t[0]), CgalMesh::Vertex_index(t[1]),
                  CgalMesh::Vertex_index(t[2]));
  reset_heap_peak();
  const double began = cpu_seconds();
  simplify(mesh);
  out.seconds = cpu_seconds() - began;
  out.peak_bytes = static_cast<double>(heap_peak_bytes() - before);
  mesh.collect_garbage();
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    out.result.position.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    bake::Triangle t{};
    std::size_t i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[i++] = v;
    out.result.triangles.push_back(t);
  }
  return out;
}

PeerRun run_lindstrom_turk(const bake::Surface& s, std::uint32_t faces) {
  return run_cgal(s, [faces](CgalMesh& mesh) {
    sms::edge_collapse(mesh, StopAt{faces, &mesh},
                       CGAL::parameters::get_cost(sms::LindstromTurk_cost<CgalMesh>())
                           .get_placement(sms::LindstromTurk_placement<CgalMesh>()));
  });
}

PeerRun run_garland_heckbert(const bake::Surface& s, std::uint32_t faces) {
  return run_cgal(s, [faces](CgalMesh& mesh) {
    const sms::GarlandHeckbert_plane_policies<CgalMesh, Kernel> policies(mesh);
    sms::edge_collapse(
        mesh, StopAt{faces, &mesh},
        CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  });
}
#endif

#if CARYATID_HAS_MESHOPTIMIZER
PeerRun run_meshoptimizer(const bake::Surface& s, std::uint32_t faces) {
  PeerRun out;
  std::vector<float> positions;
  for (const auto& p : s.position)
    for (int i = 0; i < 3; ++i) positions.push_back(static_cast<float>(p[i]));
  std::vector<unsigned> in, simple(3 * s.triangles.size());
  for (const bake::Triangle& t : s.triangles) in.insert(in.end(), t.begin(), t.end());
  reset_heap_peak();
  const std::size_t before = heap_bytes() - 12 * s.position.size() - 24 * s.triangles.size();
  const double began = cpu_seconds();
  const std::size_t n =
      meshopt_simplify(simple.data(), in.data(), in.size(), positions.data(), s.position.size(), 12,
                       std::size_t{3} * faces, 1e9f, 0, nullptr);
  out.seconds = cpu_seconds() - began;
  out.peak_bytes = static_cast<double>(heap_peak_bytes() - before);
  out.result.position = s.position;
  for (std::size_t i = 0; i < n; i += 3)
    out.result.triangles.push_back({simple[i], simple[i + 1], simple[i + 2]});
  return out;
}
#endif

}  // namespace

const std::vector<Peer>& peers() {
  static const std::vector<Peer> list = {
    {"ours", run_ours},
#if CARYATID_HAS_CGAL
    {"cgal_lindstrom_turk", run_lindstrom_turk},
    {"cgal_garland_heckbert", run_garland_heckbert},
#endif
#if CARYATID_HAS_MESHOPTIMIZER
    {"meshoptimizer", run_meshoptimizer},
#endif
  };
  return list;
}

}  // namespace caryatid::bench
