// The target as it is simulated, where it differs from the model that the component has.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hal_sim/ray_caster.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

// Whether the scenario has it differ at all (Scenario, model_...).
bool has_model_error(const Scenario& scenario);

// The model's surface (target frame, metres) without what is another node's, with the scenario's errors: a part turned, another one gone,
// then scaled, then each vertex off at random by a generator of `seed` alone, all vertices of one place alike. Which triangles are a part
// is told by their centres in the model. A part that is turned takes copies of the vertices that it shares. Throws RunError where nothing
// is left.
Mesh true_target(const Mesh& model, const Scenario& scenario, std::uint64_t seed);

// Of the triangles of true_target's mesh, in its order: which ones of the model they are.
std::vector<std::uint32_t> kept_triangles(const Mesh& model, const Scenario& scenario);

// A surface for the ray caster: triangles without area, which no ray can hit, are left out. `laser`: what each triangle reflects, or none.
std::unique_ptr<sim::RayCaster> make_target(const Mesh& mesh, const std::vector<sim::LaserReflection>& laser = {});
// The same of true_target; `laser` of the model's triangles, or none.
std::unique_ptr<sim::RayCaster> simulated_target(const Mesh& model, const Scenario& scenario, std::uint64_t seed,
                                                 const std::vector<sim::LaserReflection>& laser = {});

}  // namespace lasso::mdat
