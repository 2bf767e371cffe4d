#pragma once
// Other simplifiers, as oracles for ours. Test programs only; nothing of them is in the product.
#include <functional>

#include "assets/bake/simplify/edge_collapse.h"

namespace caryatid::bench {

// What one run took: CPU seconds, and the heap's peak with the mesh in its own form included.
struct PeerRun {
  bake::Surface result;
  double seconds = 0;
  double peak_bytes = 0;
};
struct Peer {
  const char* name;
  std::function<PeerRun(const bake::Surface&, std::uint32_t faces)> run;
};
// Those that were there when this was built.
const std::vector<Peer>& peers();

double cpu_seconds();

}  // namespace caryatid::bench
