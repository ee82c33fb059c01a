#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/bodies/body.hpp"
#include "mdat/bodies/craft.hpp"
#include "mdat/missiondb/mesh_facts.hpp"

namespace lasso::mdat {
namespace {

constexpr double kSmallest_m = 0.5, kLargest_m = 30;

BodyKind drawn_kind(sim::Random& random) {
  double left = 100 * random.uniform();
  for (std::size_t i = 0; i < kBodyKinds; ++i) {
    left -= kBodyShares[i];
    if (left < 0) return static_cast<BodyKind>(i);
  }
  return BodyKind::kPlain;
}

// Evenly in the logarithm, to three digits or so.
double drawn_size_m(sim::Random& random) {
  const double size_m = kSmallest_m * exponential(random.uniform() * sim::natural_logarithm(kLargest_m / kSmallest_m));
  return 0.001 * std::round(1000 * size_m);
}

std::string draw_parts(Body& body, Fitter& fitter) {
  switch (body.kind) {
    case BodyKind::kPlain:
      return draw_plain(body, fitter);
    case BodyKind::kCluttered:
      return draw_cluttered(body, fitter);
    case BodyKind::kSymmetric:
      return draw_symmetric(body, fitter, false);
    case BodyKind::kNearlySymmetric:
      return draw_symmetric(body, fitter, true);
    case BodyKind::kSpentStage:
      return draw_spent_stage(body, fitter);
    case BodyKind::kRock:
      return draw_rock(body, fitter);
    case BodyKind::kUnknowable:
      return draw_unknowable(body, fitter);
  }
  return "";
}

Body draw_body(std::uint64_t seed, BodyKind kind, double factor, sim::Random random) {
  Body body;
  body.seed = seed;
  body.kind = kind;
  const SolidText text(factor);
  Fitter fitter(body, text, random);
  body.what = draw_parts(body, fitter);
  return body;
}

}  // namespace

Body make_body(std::uint64_t seed, std::optional<BodyKind> kind) {
  sim::Random random(seed);
  const BodyKind drawn = drawn_kind(random);
  const double size_m = drawn_size_m(random);
  const BodyKind made = kind.value_or(drawn);
  // Drawn once to be measured, in lengths of which a millimetre is nothing, and again by the same numbers in the size that is wanted.
  constexpr double kMeasured = 100;
  const double extent = size_of(mesh_of(draw_body(seed, made, kMeasured, random))).largest_m / kMeasured;
  const double factor = size_m / (0.01 * std::round(100 * extent));
  return draw_body(seed, made, factor, random);
}

}  // namespace lasso::mdat
