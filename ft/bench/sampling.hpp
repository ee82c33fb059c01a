// The mesh as the peers want it.
#pragma once

#include "ft/bench/peers/peer.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso::bench {

PeerMesh to_peer_mesh(const mdat::Mesh& mesh);

// How far `count` points spread evenly over the surface are from each other.
double spacing_m(const mdat::Mesh& mesh, std::size_t count);

// About `count` points evenly over the surface: many random points, thinned to one in each cell of a grid for each of the six directions
// that a normal can mostly point in, so that both sides of thin parts keep theirs. The same mesh gives the same points.
PeerCloud sample_evenly(const mdat::Mesh& mesh, std::size_t count);

}  // namespace lasso::bench
